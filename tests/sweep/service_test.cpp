// What the program and its workers say to each other, and who gets which run.
#include <gtest/gtest.h>

#include "floatframe/sweep/run_queue.hpp"
#include "floatframe/sweep/sweep_service.hpp"

namespace floatframe {
namespace {

ServiceAnswer some_answer() {
  ServiceAnswer answer;
  answer.kind = ServiceAnswer::Kind::errors;
  answer.text = std::string("a\0b:3:\n", 7);
  answer.errors = {{{"file \xff.yaml", 3, 14}, ErrorCode::not_found, "found 'x'", 2, "a.b"}, {}};
  answer.files = {{"a.yaml", "0123"}, {"", ""}};
  return answer;
}

TEST(ServiceAnswer, ComesBackAsItWas) {
  const ServiceAnswer in = some_answer();
  ServiceAnswer out;
  ASSERT_TRUE(decode(encode(in), out));
  EXPECT_EQ(out.kind, in.kind);
  EXPECT_EQ(out.text, in.text);
  ASSERT_EQ(out.errors.size(), 2u);
  EXPECT_EQ(out.errors[0].text(), in.errors[0].text());
  EXPECT_EQ(out.errors[0].code, ErrorCode::not_found);
  EXPECT_EQ(out.errors[0].path, "a.b");
  EXPECT_EQ(out.files, in.files);
}

// A worker whose memory is damaged may send anything.
TEST(ServiceAnswer, AnythingElseIsRefused) {
  const std::string whole = encode(some_answer());
  ServiceAnswer out;
  for (std::size_t cut = 0; cut < whole.size(); ++cut)
    EXPECT_FALSE(decode(whole.substr(0, cut), out)) << cut;
  EXPECT_FALSE(decode(whole + "x", out));
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string damaged = whole;
    damaged[k] = '9';
    decode(damaged, out);  // must end, and not take memory that the text does not fill
  }
  EXPECT_FALSE(decode("1:9" + whole.substr(3), out));
  EXPECT_FALSE(decode("1:020:99999999999999999999", out));
  EXPECT_FALSE(decode("1:00:19:9999999999999999999", out));
}

TEST(RunQueue, OwnRunsFirstThenThoseOfTheBusiest) {
  RunQueue queue(2);
  for (std::size_t run = 0; run < 6; ++run) queue.push(run, run < 4 ? 0 : 1);
  EXPECT_EQ(queue.take(1), 4u);
  EXPECT_EQ(queue.take(0), 0u);
  EXPECT_EQ(queue.take(1), 5u);
  EXPECT_EQ(queue.take(1), 3u);
  EXPECT_EQ(queue.take(), 2u);
  EXPECT_EQ(queue.take(0), 1u);
  EXPECT_EQ(queue.take(0), std::nullopt);
  EXPECT_EQ(queue.take(), std::nullopt);
}

}  // namespace
}  // namespace floatframe
