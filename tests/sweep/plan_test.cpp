// Which runs a study consists of.
#include <gtest/gtest.h>

#include "floatframe/sweep/sweep_plan.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string error_of(const std::vector<std::string>& variations) {
  return test::error_of([&] { grid_plan(variations); });
}

TEST(GridPlan, LastVariationChangesFastest) {
  const SweepPlan plan = grid_plan({"a=1:3:3", "b=x, y", "c=true"});
  EXPECT_EQ(plan.names, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(plan.runs, (Rows{{"1", "x", "true"},
                             {"1", "y", "true"},
                             {"2", "x", "true"},
                             {"2", "y", "true"},
                             {"3", "x", "true"},
                             {"3", "y", "true"}}));
}

TEST(GridPlan, EndsOfRangesAreExactAndValuesReadBack) {
  const SweepPlan plan = grid_plan({"a=0.1:0.7:7"});
  ASSERT_EQ(plan.runs.size(), 7u);
  EXPECT_EQ(plan.runs.front().front(), "0.1");
  EXPECT_EQ(plan.runs.back().front(), "0.7");
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_DOUBLE_EQ(std::stod(plan.runs[k][0]),
                     k == 6 ? 0.7 : 0.1 + (0.7 - 0.1) * (double(k) / 6.0));
  EXPECT_EQ(grid_plan({"a=3:-1:3"}).runs, (Rows{{"3"}, {"1"}, {"-1"}}));
}

TEST(GridPlan, LogarithmicRangesHaveEqualRatios) {
  const SweepPlan plan = grid_plan({"k=1e3:1e6:4:log"});
  ASSERT_EQ(plan.runs.size(), 4u);
  double x = 1e3;
  for (const auto& run : plan.runs) {
    EXPECT_NEAR(std::stod(run[0]) / x, 1.0, 1e-14);
    x *= 10.0;
  }
  EXPECT_EQ(std::stod(plan.runs.back()[0]), 1e6);
}

TEST(GridPlan, OneValueIsTheFirst) {
  EXPECT_EQ(grid_plan({"x=3:6:1"}).runs, (std::vector<std::vector<std::string>>{{"3"}}));
  EXPECT_EQ(grid_plan({"x=3:3:1"}).runs.size(), 1u);
  EXPECT_EQ(grid_plan({"x=3:6:1:log", "y=1,2"}).runs,
            (std::vector<std::vector<std::string>>{{"3", "1"}, {"3", "2"}}));
}

TEST(GridPlan, Errors) {
  for (const char* variation : {"speed", "=1,2", "a=1:2", "a=1:2:3:lin", "a=-1:2:3:log"})
    EXPECT_EQ(error_of({variation}), "wrong_value") << variation;
  for (const char* variation : {"a=1:x:3", "a=nan:1:3", "a=1:2:0", "a=1:2:2.5", "a=1:2:1e9"})
    EXPECT_EQ(error_of({variation}), "out_of_range") << variation;
  for (const char* variation : {"a=1,,2", "a="})
    EXPECT_EQ(error_of({variation}), "missing") << variation;
  EXPECT_EQ(error_of({"a=2:2:3"}), "contradiction");
  EXPECT_EQ(error_of({"a=1,2", "a=3,4"}), "duplicate");
  EXPECT_EQ(error_of({"a=1:2:2000", "b=1:2:2000"}), "too_large");
}

class TablePlan : public testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.write("plan.csv", text); }
  std::string error_of_table(const std::string& text) {
    const std::string path = write(text);
    const std::string message = test::error_of([&] { table_plan(path); });
    return message.substr(message.find(path) + path.size());
  }
  test::TemporaryFolder folder_;
};

TEST_F(TablePlan, OneRunALine) {
  const SweepPlan plan = table_plan(
      write("\xEF\xBB\xBFspeed, road ,note\r\n5,flat,\"a, \"\"b\"\"\"\r\n\r\n 6 , bump,c\n"));
  EXPECT_EQ(plan.names, (std::vector<std::string>{"speed", "road", "note"}));
  EXPECT_EQ(plan.runs, (Rows{{"5", "flat", "a, \"b\""}, {"6", "bump", "c"}}));
  EXPECT_EQ(plan.origins[1].substr(plan.origins[1].rfind(':')), ":4");
}

TEST_F(TablePlan, ErrorsNameThePlace) {
  EXPECT_EQ(error_of_table(""), ":1:1: missing");
  EXPECT_EQ(error_of_table("a,b\n"), ":1:1: missing");
  EXPECT_EQ(error_of_table("a,b\n1,2\n1,2,3\n"), ":3:1: wrong_count");
  EXPECT_EQ(error_of_table("a,b\n1, \n"), ":2:4: missing");
  EXPECT_EQ(error_of_table("a,b\n1,\"x\n"), ":2:3: out_of_range");
  EXPECT_EQ(error_of_table("a,,b\n1,2,3\n"), ":1:1: missing");
  EXPECT_EQ(error_of_table("a,a\n1,2\n"), ":1:1: duplicate");
  EXPECT_THROW(table_plan(folder_.file("nowhere.csv")), InputError);
}

}  // namespace
}  // namespace floatframe
