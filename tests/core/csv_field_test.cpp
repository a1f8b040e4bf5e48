// Fields of CSV files: quotes, and what a spreadsheet would take for a formula.
#include "floatframe/core/csv_field.hpp"

#include <gtest/gtest.h>

namespace floatframe::test {
namespace {

TEST(CsvField, QuotesWhatNeedsThem) {
  EXPECT_EQ(csv_field("tip.x"), "tip.x");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\"\nnow"), "\"say \"\"x\"\" now\"");
  EXPECT_EQ(csv_title("tip", "m"), "tip [m]");
}

TEST(CsvField, FormulasBecomeTexts) {
  for (const char* text :
       {"=1+1", "+x", "-x", "@SUM(A1)", "\tx", "=cmd|' /C calc'!A0", "-1e", "--1", "-"}) {
    EXPECT_EQ(csv_field(text), "'" + std::string(text));
    EXPECT_EQ(csv_text(csv_field(text)), text);
  }
  EXPECT_EQ(csv_field("=HYPERLINK(\"http://x\",1)"), "\"'=HYPERLINK(\"\"http://x\"\",1)\"");
  EXPECT_EQ(csv_title("=x", "m"), "'=x [m]");
}

TEST(CsvField, NumbersStayNumbers) {
  for (const char* text : {"-1", "+2.5", "-1e-300", "-inf", "1e999", "-0"})
    EXPECT_EQ(csv_field(text), text);
  for (const char* text : {"'quoted'", "'", "", "x=1"}) EXPECT_EQ(csv_text(text), text);
}

}  // namespace
}  // namespace floatframe::test
