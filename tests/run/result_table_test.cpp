// Columns of results by their names.
#include "floatframe/run/result_table.hpp"

#include <gtest/gtest.h>

#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

TEST(ResultTable, FindsColumnsByName) {
  ResultTable table;
  table.columns = {{"time", "s"}, {"tip.x", "m"}, {"tip.z", "m"}};
  table.data = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.at(1, table.column("tip.z")), 5.0);
  EXPECT_EQ(error_of([&] { table.column("tip.zz"); }), "not_found");
}

}  // namespace
}  // namespace floatframe::test
