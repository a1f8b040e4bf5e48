// Heights over x and y by formula and grid against closed forms, tracks, friction, and their sum.
#include "floatframe/roads/road_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "floatframe/roads/crg_file.hpp"
#include "floatframe/roads/height_formula.hpp"
#include "support/allocation_counter.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

/// exp(-y^2/4) sin(x/3) + x y^2/50 and its derivatives.
SurfacePoint hill(double x, double y) {
  const double e = std::exp(-y * y / 4.0), s = std::sin(x / 3.0), c = std::cos(x / 3.0);
  SurfacePoint p;
  p.z = e * s + x * y * y / 50.0;
  p.zx = e * c / 3.0 + y * y / 50.0;
  p.zy = -0.5 * y * e * s + x * y / 25.0;
  p.zxx = -e * s / 9.0;
  p.zxy = -0.5 * y * e * c / 3.0 + y / 25.0;
  p.zyy = (0.25 * y * y - 0.5) * e * s + x / 25.0;
  return p;
}

void expect_equal(const SurfacePoint& a, const SurfacePoint& b, double tolerance) {
  EXPECT_NEAR(a.z, b.z, tolerance);
  EXPECT_NEAR(a.zx, b.zx, tolerance);
  EXPECT_NEAR(a.zy, b.zy, tolerance);
  EXPECT_NEAR(a.zxx, b.zxx, tolerance);
  EXPECT_NEAR(a.zxy, b.zxy, tolerance);
  EXPECT_NEAR(a.zyy, b.zyy, tolerance);
}

TEST(HeightFormula, ExactDerivatives) {
  const SharedFormula f = formula("exp(-y^2/4) * sin(x/3) + x * y^2 / 50");
  EXPECT_EQ(height_formula_complaint(*f), "");
  for (int k = 0; k < 50; ++k) {
    const double x = -5.0 + 0.37 * k, y = 3.0 - 0.13 * k;
    expect_equal(formula_height(*f, x, y), hill(x, y), 1e-14);
  }
  // Quotient, root, power and atan2 against central differences of the slopes.
  const SharedFormula g =
      formula("sqrt(4 + x^2 + x*y + y^2) / (2 + cos(x*y)) + atan2(y + 9, x) + (3 + y)^x");
  for (int k = 0; k < 20; ++k) {
    const double x = 0.3 + 0.11 * k, y = 1.2 - 0.09 * k, h = 1e-5;
    const SurfacePoint p = formula_height(*g, x, y);
    const SurfacePoint e = formula_height(*g, x + h, y), w = formula_height(*g, x - h, y);
    const SurfacePoint n = formula_height(*g, x, y + h), s = formula_height(*g, x, y - h);
    const double size = 1.0 + std::abs(p.z) + std::abs(p.zxx) + std::abs(p.zyy);
    EXPECT_NEAR(p.zx, (e.z - w.z) / (2.0 * h), 1e-8 * size);
    EXPECT_NEAR(p.zy, (n.z - s.z) / (2.0 * h), 1e-8 * size);
    EXPECT_NEAR(p.zxx, (e.zx - w.zx) / (2.0 * h), 1e-8 * size);
    EXPECT_NEAR(p.zxy, (n.zx - s.zx) / (2.0 * h), 1e-8 * size);
    EXPECT_NEAR(p.zyy, (n.zy - s.zy) / (2.0 * h), 1e-8 * size);
  }
}

TEST(HeightFormula, OfXAndYAlone) {
  EXPECT_NE(height_formula_complaint(*formula("x + t")), "");
  FormulaTables tables;
  tables.grids["g"] = std::make_shared<const GridTable>(
      GridTable{VecX::LinSpaced(2, 0.0, 1.0), VecX::LinSpaced(2, 0.0, 1.0), MatX::Zero(2, 2)});
  EXPECT_NE(height_formula_complaint(*formula("table2(g, x, y)", tables)), "");
  EXPECT_TRUE(std::isnan(formula_height(*formula("1 / x"), 0.0, 1.0).z));
}

HeightGrid sampled(const std::function<double(double, double)>& f, int nx, int ny,
                   GridInterpolation interpolation, GridOutside outside = GridOutside::hold) {
  std::vector<double> x, y;
  for (int i = 0; i <= nx; ++i) x.push_back(-2.0 + 8.0 * i / nx + 0.2 * std::sin(3.0 * i) / nx);
  for (int j = 0; j <= ny; ++j) y.push_back(-3.0 + 6.0 * j / ny);
  MatX z(nx + 1, ny + 1);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) z(i, j) = f(x[i], y[j]);
  return height_grid(x, y, z, interpolation, outside);
}

TEST(HeightGrid, ReproducesPolynomials) {
  // Bilinear functions by all, biquadratic ones within by the smooth one, bicubic by splines.
  const auto bilinear = [](double x, double y) { return 1.0 + 2.0 * x - y + 0.3 * x * y; };
  const auto quadratic = [](double x, double y) { return x * x - x * y * y + 0.5 * x * x * y * y; };
  const auto cubic = [](double x, double y) { return x * x * x - y * y * y * x * x + y; };
  const HeightGrid linear = sampled(bilinear, 7, 5, GridInterpolation::linear);
  const HeightGrid smooth = sampled(quadratic, 7, 5, GridInterpolation::smooth);
  const HeightGrid spline = sampled(cubic, 7, 5, GridInterpolation::spline);
  for (int k = 0; k < 60; ++k) {
    const double x = -0.7 + 0.09 * k, y = -1.7 + 0.057 * k;
    SurfacePoint p = grid_height(linear, x, y);
    expect_equal(p, {bilinear(x, y), 2.0 + 0.3 * y, -1.0 + 0.3 * x, 0.0, 0.3, 0.0, 1.0}, 1e-13);
    p = grid_height(smooth, x, y);
    expect_equal(p,
                 {quadratic(x, y), 2.0 * x - y * y + x * y * y, -2.0 * x * y + x * x * y,
                  2.0 + y * y, -2.0 * y + 2.0 * x * y, -2.0 * x + x * x, 1.0},
                 1e-12);
    p = grid_height(spline, x, y);
    expect_equal(p,
                 {cubic(x, y), 3.0 * x * x - 2.0 * y * y * y * x, -3.0 * y * y * x * x + 1.0,
                  6.0 * x - 2.0 * y * y * y, -6.0 * y * y * x, -6.0 * y * x * x, 1.0},
                 2e-11);
  }
}

TEST(HeightGrid, SmoothAcrossCells) {
  const auto f = [](double x, double y) { return hill(x, y).z; };
  const HeightGrid smooth = sampled(f, 16, 12, GridInterpolation::smooth);
  const HeightGrid spline = sampled(f, 16, 12, GridInterpolation::spline);
  const double e = 1e-9;
  for (std::size_t i = 1; i + 1 < smooth.x.size(); ++i)
    for (const double y : {-2.9, -0.3, 0.5, 1.77}) {
      const double x = smooth.x[i];
      const SurfacePoint a = grid_height(smooth, x - e, y), b = grid_height(smooth, x + e, y);
      EXPECT_NEAR(a.zx, b.zx, 1e-8);
      EXPECT_NEAR(a.zy, b.zy, 1e-8);
      const SurfacePoint c = grid_height(spline, x - e, y), d = grid_height(spline, x + e, y);
      EXPECT_NEAR(c.zxx, d.zxx, 1e-7);
      EXPECT_NEAR(c.zxy, d.zxy, 1e-7);
      EXPECT_NEAR(c.zyy, d.zyy, 1e-7);
    }
  // Fourth order of the spline.
  double coarse = 0.0, fine = 0.0;
  const HeightGrid twice = sampled(f, 32, 24, GridInterpolation::spline);
  for (int k = 0; k < 200; ++k) {
    const double x = 0.02 * k, y = -1.0 + 0.011 * k;
    coarse = std::max(coarse, std::abs(grid_height(spline, x, y).z - f(x, y)));
    fine = std::max(fine, std::abs(grid_height(twice, x, y).z - f(x, y)));
  }
  EXPECT_GT(coarse / fine, 9.0);
}

TEST(HeightGrid, Outside) {
  const auto f = [](double x, double y) { return hill(x, y).z; };
  const HeightGrid hold = sampled(f, 6, 6, GridInterpolation::smooth);
  const SurfacePoint inside = grid_height(hold, hold.x.back(), 0.4);
  const SurfacePoint beyond = grid_height(hold, hold.x.back() + 5.0, 0.4);
  EXPECT_EQ(beyond.z, inside.z);
  EXPECT_EQ(beyond.zy, inside.zy);
  EXPECT_EQ(beyond.zx, 0.0);
  const HeightGrid refuse = sampled(f, 6, 6, GridInterpolation::smooth, GridOutside::refuse);
  EXPECT_FALSE(std::isnan(grid_height(refuse, refuse.x.back(), refuse.y.front()).z));
  EXPECT_TRUE(std::isnan(grid_height(refuse, 0.0, 3.1).z));
  EXPECT_EQ(error_of([] { height_grid({0, 1}, {0, 0}, MatX::Zero(2, 2), {}, {}); }), "wrong_value");
  EXPECT_EQ(error_of([] { height_grid({0}, {0, 1}, MatX::Zero(1, 2), {}, {}); }), "wrong_count");
  EXPECT_EQ(error_of([] { height_grid({0, 1}, {0, 1}, MatX::Zero(3, 2), {}, {}); }), "wrong_count");
}

TEST(TwoTracks, LevelAcrossAtTheTracks) {
  TwoTracks t;
  t.left = PiecewisePolynomial::polynomial({0.1, 0.02, 0.003});
  t.right = PiecewisePolynomial::polynomial({-0.05, 0.01});
  t.width = 1.4;
  t.centre = 0.3;
  for (const double y : {1.001, 1.5}) {  // on the left track and beyond it
    expect_equal(tracks_height(t, 2.0, y), {0.152, 0.032, 0.0, 0.006, 0.0, 0.0, 1.0}, 1e-14);
  }
  EXPECT_NEAR(tracks_height(t, 2.0, -0.4).z, -0.03, 1e-15);
  for (const double y : {-0.2, 0.1, 0.3, 0.8}) {
    const double h = 1e-5;
    const SurfacePoint p = tracks_height(t, 2.0, y);
    const SurfacePoint n = tracks_height(t, 2.0, y + h), s = tracks_height(t, 2.0, y - h);
    EXPECT_NEAR(p.zy, (n.z - s.z) / (2.0 * h), 1e-9);
    EXPECT_NEAR(p.zxy, (n.zx - s.zx) / (2.0 * h), 1e-9);
    EXPECT_NEAR(p.zyy, (n.zy - s.zy) / (2.0 * h), 1e-9);
  }
}

TEST(RoadSurface, SumsHeightsWithoutAllocating) {
  RoadSurface s;
  s.height = formula("0.1 * sin(x) * y");
  s.grid = std::make_shared<const HeightGrid>(
      sampled([](double x, double y) { return hill(x, y).z; }, 10, 10, GridInterpolation::spline));
  CrgRoad crg =
      read_crg(std::filesystem::path(std::string(FLOATFRAME_TEST_DATA) + "/roads/curved.crg"));
  s.crg = std::make_shared<const CrgRoad>(crg);
  TwoTracks tracks;
  tracks.left = PiecewisePolynomial::polynomial({0.5, 0.1});
  s.tracks = std::make_shared<const TwoTracks>(tracks);
  s.friction = 0.8;
  s.patches = {{0.0, 5.0, -1.0, 1.0, 0.3}, {4.0, 6.0, -1.0, 1.0, 0.5}};
  const double x = 3.3, y = 0.7;
  SurfacePoint p, sum;
  const AllocationScope scope;
  add_surface(s, x, y, p);
  EXPECT_EQ(scope.count(), 0u);
  for (const SurfacePoint& part : {formula_height(*s.height, x, y), grid_height(*s.grid, x, y),
                                   crg_surface(*s.crg, x, y), tracks_height(tracks, x, y)}) {
    sum.z += part.z;
    sum.zxy += part.zxy;
  }
  EXPECT_NEAR(p.z, sum.z, 1e-15);
  EXPECT_NEAR(p.zxy, sum.zxy, 1e-14);
  EXPECT_EQ(p.friction, 0.3);
  const auto friction_at = [&](double at_x, double at_y) {
    SurfacePoint q;
    add_surface(s, at_x, at_y, q);
    return q.friction;
  };
  EXPECT_EQ(friction_at(4.5, 0.0), 0.5);
  EXPECT_EQ(friction_at(4.5, 1.5), 0.8);
}

}  // namespace
}  // namespace floatframe::test
