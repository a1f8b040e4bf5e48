// What is read back of results, and the error of each thing that cannot be.
#include "floatframe/results/results_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/results/results_csv.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

class Reading : public ::testing::Test {
 protected:
  std::string file(const std::string& text) {
    const std::string path = (folder_.path() / "r.csv").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  /// The error of a file that is refused, without its name.
  std::string complaint(const std::string& text) {
    const std::string path = file(text);
    try {
      ResultsReader in(path);
      while (in.next()) {
      }
    } catch (const InputError& error) {
      const std::string what = test::codes_of(error);
      EXPECT_EQ(what.rfind(path, 0), 0u) << what;
      return what.substr(path.size() + 1);
    }
    return "accepted";
  }
  TemporaryFolder folder_;
};

TEST_F(Reading, GivesBackEveryBit) {
  ResultTable table{{{"time", "s"}, {"a, \"b\"", "m/s"}, {"c", ""}, {"d [e]", "N"}}, {}};
  const double odd[] = {5e-324, -1e-310, 1.7976931348623157e308, -0.0, 0.1, -1.0 / 3.0};
  for (int k = 0; k < 6; ++k)
    table.data.insert(table.data.end(), {0.1 * k, odd[k], 3.0, odd[5 - k]});
  ResultsReader in(file(results_csv(table)));
  ASSERT_EQ(in.columns().size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(in.columns()[c].name, table.columns[c].name);
    EXPECT_EQ(in.columns()[c].unit, table.columns[c].unit);
  }
  for (std::size_t r = 0; r < 6; ++r) {
    ASSERT_TRUE(in.next());
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_EQ(in.row()[c], table.at(r, c));
      EXPECT_EQ(std::signbit(in.row()[c]), std::signbit(table.at(r, c)));
    }
  }
  EXPECT_FALSE(in.next());
  EXPECT_FALSE(in.torn());
  EXPECT_EQ(in.rows(), 6u);
}

TEST_F(Reading, TakesFilesOfOtherPrograms) {
  ResultsReader in(
      file("\xEF\xBB\xBFtime, x [m] ,\"y, z\"\r\n0, 1 ,\t2\r\n\r\n0.5,nan,-inf\r\n1,4,5"));
  EXPECT_EQ(in.columns()[1].name, "x");
  EXPECT_EQ(in.columns()[1].unit, "m");
  EXPECT_EQ(in.columns()[2].name, "y, z");
  ASSERT_TRUE(in.next());
  EXPECT_EQ(in.row(), (std::vector<double>{0.0, 1.0, 2.0}));
  ASSERT_TRUE(in.next());
  EXPECT_TRUE(std::isnan(in.row()[1]));
  ASSERT_TRUE(in.next());  // the last line needs no line break
  EXPECT_EQ(in.row(), (std::vector<double>{1.0, 4.0, 5.0}));
  EXPECT_FALSE(in.next());
}

TEST_F(Reading, LeavesOutALineThatWasCutOff) {
  for (const char* rest : {"0.2", "0.2,", "0.2,1,", "0.2,1e", "-"}) {
    ResultsReader in(file(std::string("time,x,y\n0,1,2\n0.1,3,4\n") + rest));
    EXPECT_TRUE(in.next());
    EXPECT_TRUE(in.next());
    EXPECT_FALSE(in.next()) << rest;
    EXPECT_TRUE(in.torn()) << rest;
    EXPECT_EQ(in.time(), 0.1) << rest;
  }
}

TEST_F(Reading, ReportsUnexpectedContent) {
  EXPECT_EQ(complaint(""), " missing");
  EXPECT_EQ(complaint("x,y\n"), "1:1: wrong_value");
  EXPECT_EQ(complaint("time,x,x\n"), "1:8: duplicate");
  EXPECT_EQ(complaint("time,\"x\n"), "1:6: damaged");
  EXPECT_EQ(complaint("time,x,y\n0,1,2\n1,a,3\n"), "3:3: out_of_range");
  EXPECT_EQ(complaint("time,x,y\n0,1\n1,2,3\n"), "2:3: out_of_range");
  EXPECT_EQ(complaint("time,x\n0,1,2\n"), "2:3: out_of_range");
  EXPECT_EQ(complaint("time,x\n0,\n1,2\n"), "2:3: out_of_range");
  EXPECT_EQ(complaint("time,x\n0,1\n0,1\n"), "3:1: contradiction");
  EXPECT_EQ(complaint("time,x\nnan,1\n"), "2:1: contradiction");
  EXPECT_EQ(complaint(std::string("time,x\n0,") + std::string(2 << 20, '1') + "\n"),
            "2:1: too_large");
  EXPECT_THROW(ResultsReader((folder_.path() / "none.csv").string()), InputError);
  EXPECT_THROW(ResultsReader(folder_.path().string()), InputError);
}

}  // namespace
}  // namespace floatframe::test
