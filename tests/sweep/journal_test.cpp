// The journal of a study: what survives, what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {
namespace {

SweepRow row(const std::string& value) {
  return {"completed", "", {{"tip.x final [m]", value}, {"a \"b\", c", "-0"}}};
}

class Journal : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "floatframe_journal_" + std::to_string(::getpid());
    std::filesystem::remove(path_);
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string text() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void set_text(const std::string& t) const { std::ofstream(path_, std::ios::binary) << t; }
  std::size_t finished(const SweepIdentity& identity = study) const {
    return SweepJournal(path_, identity, 10, false).finished().size();
  }
  std::string refusal(const SweepIdentity& identity, std::size_t runs = 10) const {
    try {
      const SweepJournal journal(path_, identity, runs, false);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::string path_;
  inline static const SweepIdentity study{{"another program", "1"}, {"another model", "abc"}};
};

TEST_F(Journal, RowsComeBackAsTheyWere) {
  {
    SweepJournal journal(path_, study, 10, false);
    journal.add(encode_row(7, row("0.10000000000000001")));
    journal.add(encode_row(0, {"failed", "joint 'a':\nno, \"way\"", {}}));
  }
  const SweepJournal journal(path_, study, 10, false);
  ASSERT_EQ(journal.finished().size(), 2u);
  EXPECT_EQ(journal.finished().at(7).fields, row("0.10000000000000001").fields);
  EXPECT_EQ(journal.finished().at(0).status, "failed");
  EXPECT_EQ(journal.finished().at(0).message, "joint 'a':\nno, \"way\"");
}

// Cut anywhere, the journal opens and holds exactly the rows whose lines are whole; a row added
// after that is not spoilt by the rest of the torn line.
TEST_F(Journal, CutAnywhereItKeepsTheWholeLines) {
  {
    SweepJournal journal(path_, study, 10, false);
    for (std::size_t run = 0; run < 3; ++run) journal.add(encode_row(run, row("1")));
  }
  const std::string whole = text();
  for (std::size_t cut = 0; cut <= whole.size(); cut += 7) {
    set_text(whole.substr(0, cut));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(cut), '\n');
    const std::size_t expected = lines > 1 ? static_cast<std::size_t>(lines - 1) : 0;
    ASSERT_EQ(finished(), expected) << cut;
    SweepJournal(path_, study, 10, false).add(encode_row(9, row("2")));
    ASSERT_EQ(finished(), expected + 1) << cut;
  }
}

TEST_F(Journal, DamagedLinesAreLeftOut) {
  {
    SweepJournal journal(path_, study, 10, false);
    for (std::size_t run = 0; run < 3; ++run) journal.add(encode_row(run, row("1")));
  }
  std::string damaged = text();
  const std::size_t at = damaged.find("\"run\":2");
  damaged[at + 6] = '5';  // a line that would be read as another run
  set_text(damaged);
  const SweepJournal journal(path_, study, 10, false);
  EXPECT_EQ(journal.finished().size(), 2u);
  EXPECT_FALSE(journal.finished().contains(1));
  EXPECT_FALSE(journal.finished().contains(4));
}

TEST_F(Journal, AnotherStudyIsRefusedWithTheReason) {
  SweepJournal(path_, study, 10, false).add(encode_row(0, row("1")));
  const std::string before = text();
  const std::string start = "'" + path_ + "' holds another study (";
  const std::string end = "); give another --out to keep it, or --fresh to replace it";
  EXPECT_EQ(refusal({{"another program", "2"}, {"another model", "xyz"}}),
            start + "another program" + end);
  EXPECT_EQ(refusal({{"another program", "1"}, {"another model", "xyz"}}),
            start + "another model" + end);
  EXPECT_EQ(refusal(study, 11), start + "the runs differ" + end);
  EXPECT_EQ(text(), before);
  EXPECT_EQ(SweepJournal(path_, {{"another program", "2"}}, 10, true).finished().size(), 0u);
  EXPECT_EQ(finished({{"another program", "2"}}), 0u);
}

TEST_F(Journal, SomebodyElsesFileIsLeftAlone) {
  set_text("time [s],x\n0,1\n");
  EXPECT_EQ(refusal(study),
            "'" + path_ + "' is not the journal of a study; give another --out, or --fresh");
  EXPECT_EQ(text(), "time [s],x\n0,1\n");
  set_text("a long line without an end, not ours");
  EXPECT_EQ(refusal(study), "'" + path_ + "' is not the journal of a study");
}

TEST_F(Journal, OneProcessAtATime) {
  const SweepJournal first(path_, study, 10, false);
  EXPECT_EQ(refusal(study), "'" + path_ + "' is in use: this study is running already");
}

TEST(ContentHash, IsFnv1a128) {
  // Reference: FNV-1a 128 of the length (8 bytes, little endian) followed by the bytes.
  EXPECT_EQ(ContentHash().text(), "6c62272e07bb014262b821756295c58d");
  EXPECT_NE(content_hash("ab"), content_hash("ba"));
  EXPECT_NE(ContentHash().add("ab").add("c").text(), ContentHash().add("a").add("bc").text());
}

}  // namespace
}  // namespace floatframe
