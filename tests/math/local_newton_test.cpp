// The damped iteration for a few unknowns: its order, its damping, and that it ends.
#include "floatframe/math/local_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace floatframe {
namespace {

/// Solves gap(y) = 0 from y; the number of evaluations, -1 if there is no solution.
template <class Gap, class Slope>
int solve(double& y, const Gap& gap, const Slope& slope) {
  LocalNewton newton(1);
  VecX x = VecX::Constant(1, y);
  int count = 0;
  const bool solved = newton.solve(
      x,
      [&] {
        ++count;
        newton.gap[0] = gap(x[0]);
        newton.size[0] = std::max(newton.size[0], std::abs(x[0]));
      },
      [&] { newton.slopes(0, 0) = slope(x[0]); });
  y = x[0];
  return solved ? count : -1;
}

TEST(LocalNewton, ALinearEquationTakesOneStep) {
  double y = 0.3;
  EXPECT_LE(solve(
                y, [](double x) { return 4.0 * x - 8.0; }, [](double) { return 4.0; }),
            3);
  EXPECT_EQ(y, 2.0);
}

TEST(LocalNewton, IsQuadratic) {
  double y = 1.0;
  EXPECT_LE(solve(
                y, [](double x) { return x * x - 2.0; }, [](double x) { return 2.0 * x; }),
            6);
  EXPECT_NEAR(y, std::sqrt(2.0), 1e-15);
}

// Without damping it jumps between -10 and 10 for ever.
TEST(LocalNewton, IsDamped) {
  double y = 1.3;
  const auto slope = [](double x) { return 0.1 + 5.0 / std::pow(std::cosh(5.0 * (x - 1.0)), 2); };
  EXPECT_GT(solve(
                y, [](double x) { return 0.1 * x + std::tanh(5.0 * (x - 1.0)); }, slope),
            5);
  EXPECT_NEAR(y, 0.9803302213073878, 1e-12);
}

TEST(LocalNewton, SaysThatThereIsNoSolution) {
  double y = 1.0;
  EXPECT_EQ(solve(
                y, [](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; }),
            -1);
  y = 1.0;
  EXPECT_EQ(solve(
                y, [](double) { return std::nan(""); }, [](double) { return 1.0; }),
            -1);
  y = 1.0;
  EXPECT_EQ(solve(
                y, [](double) { return 1.0; }, [](double) { return 0.0; }),
            -1);
}

TEST(LocalNewton, NothingIsSolvedAtOnce) {
  LocalNewton newton(0);
  VecX none;
  EXPECT_TRUE(newton.solve(
      none, [] {}, [] {}));
}

}  // namespace
}  // namespace floatframe
