// Tables, road profiles, sums and the continuity check of piecewise polynomials.
#include "floatframe/math/piecewise_build.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/error_of.hpp"

namespace floatframe {
namespace {

TEST(Table, LinearPassesThroughItsPointsAndContinues) {
  const auto f = table_function({{0, 1}, {1, 3}, {3, 2}}, Interpolation::linear, Beyond::tangent);
  EXPECT_DOUBLE_EQ(f(-1).f, -1.0);
  EXPECT_DOUBLE_EQ(f(0.5).f, 2.0);
  EXPECT_DOUBLE_EQ(f(2).f, 2.5);
  EXPECT_DOUBLE_EQ(f(5).f, 1.0);
  const auto g = table_function({{0, 1}, {1, 3}, {3, 2}}, Interpolation::linear, Beyond::hold);
  EXPECT_DOUBLE_EQ(g(-1).f, 1.0);
  EXPECT_DOUBLE_EQ(g(5).f, 2.0);
}

TEST(Table, CubicIsMonotoneAndSmooth) {
  const std::vector<TablePoint> p{{0, 0}, {1, 0.1}, {2, 5}, {3, 5.1}, {5, 6}, {6, 6}};
  for (const Beyond beyond : {Beyond::tangent, Beyond::hold}) {
    const auto f = table_function(p, Interpolation::cubic, beyond);
    for (const TablePoint& q : p) EXPECT_NEAR(f(q.x).f, q.f, 1e-14);
    double last = f(0).f;
    for (double x = 0.0; x < 6.0; x += 0.01) {
      EXPECT_GE(f(x).f, last - 1e-12);
      last = f(x).f;
    }
    for (std::size_t k = 0; k < f.breaks().size(); ++k) {
      const double x = f.breaks()[k];
      EXPECT_NEAR(f.piece_value(k, x).f, f.piece_value(k + 1, x).f, 1e-13);
      EXPECT_NEAR(f.piece_value(k, x).df, f.piece_value(k + 1, x).df, 1e-13);
    }
  }
  // Two points: a straight line.
  const auto line = table_function({{0, 1}, {2, 5}}, Interpolation::cubic, Beyond::tangent);
  EXPECT_DOUBLE_EQ(line(3).f, 7.0);
}

TEST(TimeTable, JumpsBetweenTwoSides) {
  const auto step = time_table({{0.5, 0}, {0.5, 1}}, Interpolation::linear);
  EXPECT_EQ(step(-3).f, 0.0);
  EXPECT_EQ(step(std::nextafter(0.5, 0.0)).f, 0.0);
  EXPECT_EQ(step(0.5).f, 1.0) << "the second point counts at the jump";
  EXPECT_EQ(step(7).f, 1.0);
  EXPECT_EQ(step.edges(), std::vector<double>{0.5});
  const std::vector<TablePoint> p{{0, 1}, {1, 3}, {2, 3}, {2, -1}, {3, 0}, {3, 4}, {3.5, 4}};
  const auto line = time_table(p, Interpolation::linear);
  EXPECT_DOUBLE_EQ(line(0.5).f, 2.0);
  EXPECT_DOUBLE_EQ(line(2.5).f, -0.5);
  EXPECT_DOUBLE_EQ(line(2.5).df, 1.0);
  EXPECT_DOUBLE_EQ(line(3).f, 4.0);
  EXPECT_DOUBLE_EQ(line(9).f, 4.0);
  EXPECT_EQ(line.edges(), (std::vector<double>{0, 1, 2, 3}));
  // Each side as a table of its own; ends of the whole are flat, since they are held.
  const auto cubic = time_table(p, Interpolation::cubic);
  const auto left = table_function({p[0], p[1], p[2]}, Interpolation::cubic, Beyond::tangent);
  EXPECT_EQ(cubic(1.5).f, left(1.5).f);
  EXPECT_EQ(cubic(0).df, 0.0);
  EXPECT_DOUBLE_EQ(cubic(2.5).f, -0.5);
  EXPECT_EQ(cubic.edges(), (std::vector<double>{2, 3}));
  // Without a jump it is the table that is held.
  const std::vector<TablePoint> q{{0, 1}, {1, 3}, {2, 0}, {4, 1}};
  for (const Interpolation i : {Interpolation::linear, Interpolation::cubic})
    for (double x = -1.0; x < 5.0; x += 0.13)
      EXPECT_EQ(time_table(q, i)(x).f, table_function(q, i, Beyond::hold)(x).f);
  // Two points that are the same jump nowhere.
  EXPECT_TRUE(time_table({{0, 2}, {1, 2}, {1, 2}}, Interpolation::linear).edges().empty());
}

TEST(Profile, JumpsAndFlatEnds) {
  const auto f = profile_function({{5, 0}, {15, 2}, {20, 2}, {20, 1.7}, {21, 1.7}, {21, 0}});
  EXPECT_DOUBLE_EQ(f(-10).f, 0.0);
  EXPECT_DOUBLE_EQ(f(10).f, 1.0);
  EXPECT_DOUBLE_EQ(f(10).df, 0.2);
  EXPECT_DOUBLE_EQ(f(19.999).f, 2.0);
  EXPECT_DOUBLE_EQ(f(20).f, 1.7);
  EXPECT_DOUBLE_EQ(f(20.5).f, 1.7);
  EXPECT_DOUBLE_EQ(f(21).f, 0.0);
  EXPECT_DOUBLE_EQ(f(100).f, 0.0);
  EXPECT_EQ(profile_function({{0, 0.3}})(7).f, 0.3);
}

TEST(Sum, AddsValuesAndSlopes) {
  const PiecewisePolynomial a({0.5}, {{0.5, {1, 2, 3}}, {-1, {4, 5}}});
  const PiecewisePolynomial b({0.2, 0.5, 0.9},
                              {{0, {1}}, {2, {0, 1, 1, 1}}, {0, {7}}, {1, {1, 1}}});
  const PiecewisePolynomial c = a + b;
  EXPECT_EQ(c.breaks().size(), 3u);
  for (double x = -2.0; x < 3.0; x += 0.05) {
    EXPECT_NEAR(c(x).f, a(x).f + b(x).f, 1e-12);
    EXPECT_NEAR(c(x).df, a(x).df + b(x).df, 1e-12);
    EXPECT_NEAR(c(x).ddf, a(x).ddf + b(x).ddf, 1e-12);
  }
}

TEST(Stops, ActOnTheirSide) {
  const auto bump = ramp_below(0.1, 1000), rebound = ramp_above(0.3, 500);
  EXPECT_DOUBLE_EQ(bump(0.05).f, -50.0);
  EXPECT_DOUBLE_EQ(bump(0.2).f, 0.0);
  EXPECT_DOUBLE_EQ(rebound(0.2).f, 0.0);
  EXPECT_DOUBLE_EQ(rebound(0.5).f, 100.0);
}

TEST(Continuity, JumpAgainstRange) {
  const PiecewisePolynomial joined({1.0}, {{0, {0, 100}}, {1, {100, 300}}});
  EXPECT_TRUE(largest_jump(joined).continuous());
  const PiecewisePolynomial nearly({1.0}, {{0, {0, 100}}, {1, {100.0001, 300}}});
  EXPECT_TRUE(largest_jump(nearly).continuous());
  const PiecewisePolynomial jump({1.0}, {{0, {0, 100}}, {1, {100.01, 300}}});
  EXPECT_FALSE(largest_jump(jump).continuous());
  EXPECT_NEAR(largest_jump(jump).jump, 0.01, 1e-12);
  EXPECT_TRUE(largest_jump(PiecewisePolynomial()).continuous());
}

TEST(Table, PointsThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto table = [](const std::vector<TablePoint>& p) {
    return test::error_of([&] { table_function(p, Interpolation::cubic, Beyond::hold); });
  };
  EXPECT_EQ(table({}), "out_of_range");
  EXPECT_EQ(table({{0, 1}}), "out_of_range");
  EXPECT_EQ(table({{0, 1}, {0, 2}}), "contradiction");
  EXPECT_EQ(table({{0, 1}, {1, nan}}), "not_finite");
  const auto time = [](const std::vector<TablePoint>& p) {
    return test::error_of([&] { time_table(p, Interpolation::linear); });
  };
  EXPECT_EQ(time({{0, 1}, {0, 2}}), "no error");
  EXPECT_EQ(time({{0, 1}}), "out_of_range");
  EXPECT_EQ(time({{0, 1}, {0, 2}, {0, 3}}), "duplicate");
  EXPECT_EQ(time({{1, 1}, {0, 2}}), "contradiction");
  const auto profile = [](const std::vector<TablePoint>& p) {
    return test::error_of([&] { profile_function(p); });
  };
  EXPECT_EQ(profile({}), "out_of_range");
  EXPECT_EQ(profile({{1, 0}, {0, 0}}), "contradiction");
  EXPECT_EQ(profile({{0, 0}, {0, 1}}), "no error");
}

TEST(PiecewiseBuild, EdgesAreJumpsOfValueOrSlope) {
  const PiecewisePolynomial stairs =
      profile_function({{0, 0}, {1, 0}, {1, -0.5}, {2, -0.5}, {3, -0.5}, {4, 0.5}});
  EXPECT_EQ(stairs.edges(), (std::vector<double>{1, 3, 4}));
  EXPECT_EQ(stairs.stretch_index(0.5), 0u);
  EXPECT_EQ(stairs.stretch_index(1.0), 1u);
  EXPECT_EQ(stairs.stretch_value(0, 1.5).f, 0.0) << "beyond its edge";
  EXPECT_EQ(stairs.stretch_value(1, 0.5).f, -0.5);
  EXPECT_NEAR(stairs.stretch_value(2, 4.5).f, 1.0, 1e-15) << "along the tangent";
  EXPECT_EQ(stairs.stretch_value(99, 5.0).f, 0.5) << "the last one";
  const std::vector<TablePoint> points{{0, 0}, {1, 3}, {2, 4}, {4, 9}};
  EXPECT_TRUE(table_function(points, Interpolation::cubic, Beyond::tangent).edges().empty());
  // Slopes that are zero but for rounding at all points.
  EXPECT_TRUE(
      table_function({{0, 0}, {1, 0}, {11, 0.3}, {100, 0.3}}, Interpolation::cubic, Beyond::hold)
          .edges()
          .empty());
  EXPECT_EQ(table_function(points, Interpolation::linear, Beyond::tangent).edges(),
            (std::vector<double>{1, 2}));
  // A cubic piece does not grow beyond its edge as its cube does.
  const PiecewisePolynomial cubic({1.0}, {{0.0, {0, 0, 0, 1}}, {0.0, {1}}});
  EXPECT_EQ(cubic.stretch_value(0, 11.0).f, 31.0);
  EXPECT_EQ(cubic.stretch_value(0, 0.5).f, 0.125);
  // A function that is not valid has none, and can be looked at by the checks of models.
  EXPECT_TRUE(PiecewisePolynomial({1.0, 2.0}, {{0.0, {1.0}}}).edges().empty());
}

TEST(Repeated, EqualsTheFunctionAFewPeriodsOn) {
  for (const double period : {2.0, 3.5}) {
    const auto f = time_table({{1, 0}, {1.5, 2}, {1.5, -1}, {3, 0}}, Interpolation::linear, period);
    const auto all = repeated(f, period, -4.0, 12.0, 1000);
    for (double x = -4.0; x < 12.0; x += 0.1237) {
      const double base = x - period * std::floor((x - 1.0) / period);
      EXPECT_NEAR(all(x).f, f(base).f, 1e-12) << x;
      EXPECT_NEAR(all(x).df, f(base).df, 1e-12) << x;
    }
    EXPECT_EQ(repeated(f, 0.0, -4.0, 12.0, 1000).breaks(), f.breaks());
    EXPECT_LE(repeated(f, period, 0.0, std::numeric_limits<double>::infinity(), 50).pieces().size(),
              50u);
  }
}

TEST(Steps, AreZeroBeforeTheFirst) {
  const auto f = step_function({{1, 4}, {2, -3}});
  EXPECT_EQ(f(0.999).f, 0.0);
  EXPECT_EQ(f(1.0).f, 4.0);
  EXPECT_EQ(f(1.999).f, 4.0);
  EXPECT_EQ(f(2.0).f, -3.0);
  EXPECT_EQ(f(9.0).df, 0.0);
  EXPECT_EQ(test::error_of([] { step_function({{1, 4}, {1, 5}}); }), "contradiction");
}

TEST(Integral, IsContinuousAndHasTheFunctionAsItsSlope) {
  for (const PiecewisePolynomial& f :
       {time_table({{0, 1}, {1, 3}, {1, -2}, {2.5, 0.5}}, Interpolation::linear),
        time_table({{-1, 1}, {1, 3}, {2.5, 0.5}, {4, 0}}, Interpolation::cubic),
        PiecewisePolynomial::polynomial({1.0, -2.0, 3.0})})
    for (const double x0 : {-2.0, 0.5, 9.0}) {
      const auto F = integral(f, x0, 7.0);
      EXPECT_NEAR(F(x0).f, 7.0, 1e-13);
      EXPECT_TRUE(largest_jump(F).continuous());
      for (double x = -3.0; x < 10.0; x += 0.173) {
        EXPECT_NEAR(F(x).df, f(x).f, 1e-12) << x;
        EXPECT_NEAR(F(x).ddf, f(x).df, 1e-12) << x;
      }
    }
}

}  // namespace
}  // namespace floatframe
