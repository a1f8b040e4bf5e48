// Cubic splines: cubics are exact, closed ones meet with slope and curvature, and the error of the
// curvature falls with the square of the distance of the points.
#include "floatframe/math/cubic_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

TEST(CubicSpline, OfACubicIsTheCubic) {
  const auto f = [](double x) { return 1.0 + 2.0 * x - 3.0 * x * x + 0.5 * x * x * x; };
  for (const int n : {4, 5, 9}) {
    std::vector<TablePoint> points;
    for (int k = 0; k < n; ++k) {
      const double x = 0.3 * k + 0.02 * k * k;
      points.push_back({x, f(x)});
    }
    const PiecewisePolynomial s = cubic_spline(points, SplineEnds::open);
    for (double x = points[0].x; x < points.back().x; x += 0.01) {
      EXPECT_NEAR(s(x).f, f(x), 1e-12);
      EXPECT_NEAR(s(x).df, 2.0 - 6.0 * x + 1.5 * x * x, 1e-11);
      EXPECT_NEAR(s(x).ddf, -6.0 + 3.0 * x, 1e-9);
    }
    // Beyond its ends it goes on along its tangents.
    const double end = points.back().x;
    EXPECT_NEAR(s(end + 1.0).f, f(end) + 2.0 - 6.0 * end + 1.5 * end * end, 1e-10);
    EXPECT_EQ(s(end + 1.0).ddf, 0.0);
  }
}

TEST(CubicSpline, OfTwoAndThreePointsIsALineAndAParabola) {
  const PiecewisePolynomial line = cubic_spline({{1.0, 2.0}, {3.0, 6.0}}, SplineEnds::open);
  EXPECT_NEAR(line(2.5).f, 5.0, 1e-14);
  const PiecewisePolynomial arc =
      cubic_spline({{0.0, 0.0}, {1.0, 1.0}, {3.0, 9.0}}, SplineEnds::open);
  EXPECT_NEAR(arc(2.0).f, 4.0, 1e-13);
  EXPECT_NEAR(arc(2.0).ddf, 2.0, 1e-13);
}

TEST(CubicSpline, ThatIsClosedMeetsWithSlopeAndCurvature) {
  for (const int n : {2, 3, 4, 7}) {
    std::vector<TablePoint> points;
    for (int k = 0; k <= n; ++k) points.push_back({1.0 * k + 0.1 * (k % 2), std::sin(3.0 * k)});
    points.back().f = points.front().f;
    const PiecewisePolynomial s = cubic_spline(points, SplineEnds::closed);
    for (const TablePoint& p : points) EXPECT_NEAR(s(p.x).f, p.f, 1e-13);
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      const auto before = s.piece_value(k, points[k].x), after = s.piece_value(k + 1, points[k].x);
      EXPECT_NEAR(before.df, after.df, 1e-12);
      EXPECT_NEAR(before.ddf, after.ddf, 1e-11);
    }
    const auto first = s.piece_value(1, points[0].x);
    const auto last = s.piece_value(points.size() - 1, points.back().x);
    EXPECT_NEAR(first.df, last.df, 1e-12) << n;
    EXPECT_NEAR(first.ddf, last.ddf, 1e-11) << n;
  }
}

TEST(CubicSpline, CurvatureFallsWithTheSquareOfTheDistance) {
  for (const SplineEnds ends : {SplineEnds::open, SplineEnds::closed}) {
    double before = 0.0;
    for (const int n : {40, 80, 160}) {
      std::vector<TablePoint> points;
      for (int k = 0; k <= n; ++k) {
        const double x = 2.0 * std::numbers::pi * k / n;
        points.push_back({x, std::sin(x) + 0.3 * std::cos(2.0 * x)});
      }
      points.back().f = points.front().f;
      const PiecewisePolynomial s = cubic_spline(points, ends);
      double error = 0.0;
      for (double x = 1.0; x < 5.0; x += 0.003)
        error = std::max(error, std::abs(s(x).ddf + std::sin(x) + 1.2 * std::cos(2.0 * x)));
      if (before > 0.0) {
        EXPECT_NEAR(before / error, 4.0, 0.2);
      }
      before = error;
    }
  }
}

TEST(CubicSpline, NeedsAscendingPoints) {
  EXPECT_THROW(cubic_spline({{0.0, 0.0}, {0.0, 1.0}}, SplineEnds::open), InputError);
  EXPECT_THROW(cubic_spline({{0.0, 0.0}}, SplineEnds::open), InputError);
  EXPECT_THROW(cubic_spline({{0.0, 0.0}, {1.0, 0.0}}, SplineEnds::closed), InputError);
}

}  // namespace
}  // namespace floatframe
