// Functions of time: sines, chirps and periods, their values in closed form and their derivatives
// against differences.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe {
namespace {

constexpr double pi = std::numbers::pi;

void expect_derivatives(const TimeFunction& f, double t) {
  constexpr double h = 1e-5;
  const auto low = evaluate(f, t - h), here = evaluate(f, t), high = evaluate(f, t + h);
  const double scale = 1.0 + std::abs(here.f) + std::abs(here.df) + std::abs(here.ddf);
  EXPECT_NEAR((high.f - low.f) / (2.0 * h), here.df, 1e-6 * scale) << t;
  EXPECT_NEAR((high.df - low.df) / (2.0 * h), here.ddf, 1e-6 * scale) << t;
}

TEST(TimeFunctions, SinesAdd) {
  TimeFunction f;
  f.pieces = PiecewisePolynomial::polynomial({1.0, 2.0});
  f.sines = {{.amplitude = 3.0, .frequency = 0.25},
             {.amplitude = 0.5, .frequency = 2.0, .phase = 0.7}};
  for (const double t : {-0.3, 0.0, 1.0, 2.31}) {
    EXPECT_NEAR(evaluate(f, t).f,
                1.0 + 2.0 * t + 3.0 * std::sin(0.5 * pi * t) + 0.5 * std::sin(4.0 * pi * t + 0.7),
                1e-14);
    expect_derivatives(f, t);
  }
}

TEST(TimeFunctions, AChirpSweepsAndKeepsItsPhase) {
  TimeFunction f;
  f.sines = {{.amplitude = 2.0,
              .frequency = 1.0,
              .phase = 0.3,
              .rate = 1.5,
              .start = 0.5,
              .duration = 2.0}};  // 1 to 4 Hz
  const auto expected = [](double t) {
    const double s = t - 0.5;
    if (s < 0.0) return 2.0 * std::sin(2.0 * pi * s + 0.3);
    if (s < 2.0) return 2.0 * std::sin(2.0 * pi * (s + 0.75 * s * s) + 0.3);
    return 2.0 * std::sin(2.0 * pi * (5.0 + 4.0 * (s - 2.0)) + 0.3);
  };
  for (double t = -1.0; t < 4.0; t += 0.0937) {
    EXPECT_NEAR(evaluate(f, t).f, expected(t), 1e-12) << t;
    expect_derivatives(f, t);
  }
  for (const double t : {0.5, 2.5}) {  // value and rate are continuous at both ends
    const auto left = evaluate(f, t - 1e-9), right = evaluate(f, t + 1e-9);
    EXPECT_NEAR(left.f, right.f, 1e-6);
    EXPECT_NEAR(left.df, right.df, 1e-5);
  }
}

TEST(TimeFunctions, RepeatBeforeAndAfter) {
  TimeFunction f;
  f.pieces =
      time_table({{0.2, 1.0}, {0.5, 3.0}, {0.9, -1.0}, {1.2, 1.0}}, Interpolation::cubic, 1.0);
  f.period = 1.0;
  for (const double t : {0.25, 0.61, 1.0, 1.15})
    for (const double n : {-3.0, -1.0, 1.0, 40.0}) {
      EXPECT_NEAR(evaluate(f, t + n).f, evaluate(f, t).f, 1e-12);
      expect_derivatives(f, t + n);
    }
  // The slope at the joint of two periods is that of its two sides.
  EXPECT_NEAR(evaluate(f, 0.2 - 1e-9).df, evaluate(f, 0.2 + 1e-9).df, 1e-5);
  EXPECT_GT(evaluate(f, 0.2).df, 1.0);
}

TEST(TimeFunctions, ATableShorterThanItsPeriodHoldsItsLastValue) {
  TimeFunction f;
  f.pieces = step_function({{0.1, 5.0}, {0.3, -2.0}});
  f.period = 0.7;
  for (const double n : {-2.0, 0.0, 1.0, 1000.0}) {
    const double t = 0.7 * n;
    EXPECT_EQ(evaluate(f, t + 0.2).f, 5.0);
    EXPECT_EQ(evaluate(f, t + 0.31).f, -2.0);
    EXPECT_EQ(evaluate(f, t + 0.79).f, -2.0);
  }
}

// The instants at which steps are divided have the values of the right side, in spite of rounding,
// and those just before have the left one.
TEST(TimeFunctions, RepeatedJumpsAreAtTheirInstants) {
  TimeFunction f;
  f.pieces = step_function({{0.1, 5.0}, {0.37, -2.0}});
  f.period = 0.7;
  const PiecewisePolynomial all = repeated(f.pieces, f.period, 0.0, 1e4, 1'000'000);
  EXPECT_GT(all.breaks().size(), 28'000u);
  for (const double at : all.breaks()) {
    const double before = at - 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at);
    ASSERT_EQ(evaluate(f, at).f, all(at).f) << at;
    ASSERT_EQ(evaluate(f, before).f, all(before).f) << at;
    ASSERT_NE(evaluate(f, at).f, evaluate(f, before).f) << at;
  }
}

TEST(TimeFunctions, AllocateNothing) {
  TimeFunction f;
  f.pieces = time_table({{0.0, 1.0}, {0.5, 3.0}, {1.0, 1.0}}, Interpolation::linear, 1.0);
  f.period = 1.0;
  f.sines = {{.amplitude = 1.0, .frequency = 2.0},
             {.amplitude = 1.0, .frequency = 2.0, .rate = 1.0, .duration = 3.0}};
  const test::AllocationScope scope;
  double sum = 0.0;
  for (double t = 0.0; t < 5.0; t += 0.01) sum += evaluate(f, t).f;
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_NE(sum, 0.0);
}

}  // namespace
}  // namespace floatframe
