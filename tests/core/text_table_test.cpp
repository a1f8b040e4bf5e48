// Alignment of text tables.
#include "floatframe/core/text_table.hpp"

#include <gtest/gtest.h>

namespace floatframe {
namespace {

TEST(TextTable, AlignsColumnsAndCountsCharacters) {
  TextTable table({"body", "x [m]", "note"}, {2});
  EXPECT_TRUE(table.empty());
  table.add({"ch\xC3\xA2ssis", "1.5", "a"});
  table.add({"arm", "-10.25", ""});
  EXPECT_FALSE(table.empty());
  EXPECT_EQ(table.text(2),
            "  body      x [m]  note\n"
            "  ch\xC3\xA2ssis     1.5  a\n"
            "  arm      -10.25\n");
}

}  // namespace
}  // namespace floatframe
