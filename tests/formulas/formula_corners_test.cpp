// Jumps of formulas of time and of their slopes, against where they are; smooth ones have none.
#include "floatframe/formulas/formula_corners.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace floatframe {
namespace {

FormulaCorners corners(const std::string& text, double end = 1.0, double step = 1e-3) {
  return formula_corners(*formula(text), 0.0, end, step);
}

struct Jumping {
  const char* formula;
  double at, size;
};

TEST(FormulaCorners, FindsJumps) {
  for (const Jumping& x :
       {Jumping{"floor(5 * t)", 0.2, 1.0},
        {"if(t < 0.2, 0, 1)", 0.2, 1.0},
        {"round(10 * t) * 0.1", 0.05, 0.1},
        {"ceil(3 * t - 0.5) + sin(40 * t)", 0.5 / 3.0, 1.0},
        {"sign(t - 0.123)", 0.123, 1.0},
        {"1e3 * t + 1e-2 * floor(t / 0.7301)", 0.7301, 1e-2},
        {"atan2(sin(9 * t), cos(9 * t))", 0.34906585039886592, -6.2831853071795865},
        {"1e-6 * floor(2 * t)", 0.5, 1e-6}}) {
    const FormulaCorners found = corners(x.formula);
    ASSERT_TRUE(found.jump) << x.formula;
    EXPECT_NEAR(found.jump->at, x.at, 1e-12) << x.formula;
    // Of `sign` a half: it is zero at zero.
    EXPECT_NEAR(found.jump->size, x.size, 1e-9 * std::abs(x.size)) << x.formula;
  }
  EXPECT_TRUE(corners("if(t < 12.34, 0, 1)", std::numeric_limits<double>::infinity(), 0.01).jump);
  EXPECT_FALSE(corners("if(t < 12.34, 0, 1)", 12.0).jump);
}

TEST(FormulaCorners, FindsJumpsOfTheSlope) {
  for (const Jumping& x : {Jumping{"abs(t - 0.3)", 0.3, 2.0},
                           {"if(t < 0.25, 0, t - 0.25)", 0.25, 1.0},
                           {"max(0, t - 0.5003) + t^2", 0.5003, 1.0},
                           {"clip(20 * t, -1, 7) + sin(5 * t)", 0.35, -20.0}}) {
    const FormulaCorners found = corners(x.formula);
    EXPECT_FALSE(found.jump) << x.formula;
    EXPECT_EQ(found.slopes, 1u) << x.formula;
    ASSERT_TRUE(found.slope) << x.formula;
    EXPECT_NEAR(found.slope->at, x.at, 1e-12) << x.formula;
    EXPECT_NEAR(found.slope->size, x.size, 1e-9 * std::abs(x.size)) << x.formula;
  }
  EXPECT_EQ(corners("abs(sin(10 * pi * t))", 1.05).slopes, 10u);
}

TEST(FormulaCorners, SmoothOnesHaveNone) {
  for (const char* const text :
       {"sin(30 * t) + t^3", "smoothstep(t, 0.1, 0, 0.4, 40)", "tanh(1e5 * (t - 0.5))",
        "if(t < 0.5, t^2, t - 0.25)", "0.1 * sqrt(t + 0.01) / (1 + t^2)", "(t + 1)^t",
        "atan2(t, 1)", "sign(t - 0.5, 1e-4)", "chirp(t, 1, 200, 1)", "1e5 + sin(3 * t) / (2 + t)",
        "log(1 + t) * exp(-40 * t) / 3", "(t^2)^1.5", "max(t, t - 1)"}) {
    const FormulaCorners found = corners(text);
    EXPECT_FALSE(found.jump) << text << " at " << found.jump->at << " by " << found.jump->size;
    EXPECT_FALSE(found.slope) << text << " at " << found.slope->at << " by " << found.slope->size;
  }
}

}  // namespace
}  // namespace floatframe
