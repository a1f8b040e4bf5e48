// TMeasy against a table of an independent computation, its derivatives against differences.
#include "floatframe/tyres/tmeasy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/named_rows.hpp"

namespace floatframe {
namespace {

TwoLoads tmeasy_loads(const nlohmann::json& values) {
  return {values.at(0).get<double>(), values.at(1).get<double>()};
}
TmeasyAxis tmeasy_axis(const nlohmann::json& j) {
  return {.slope = tmeasy_loads(j.at("d")),
          .maximum = tmeasy_loads(j.at("fm")),
          .sliding = tmeasy_loads(j.at("fs")),
          .maximum_slip = tmeasy_loads(j.at("sm")),
          .sliding_slip = tmeasy_loads(j.at("ss"))};
}
Tmeasy tmeasy_of(const std::string& set) {
  std::ifstream in(FLOATFRAME_TEST_DATA "/tyres/tmeasy/parameters.json");
  const nlohmann::json j = nlohmann::json::parse(in).at(set);
  const nlohmann::json& a = j.at("a");
  Tmeasy t;
  t.nominal_load = j.at("pn").get<double>();
  t.max_load = 3.5 * t.nominal_load;
  t.x = tmeasy_axis(j.at("x"));
  t.y = tmeasy_axis(j.at("y"));
  t.trail = {tmeasy_loads(a.at("n")), tmeasy_loads(a.at("s0")), tmeasy_loads(a.at("se"))};
  t.radius = j.at("R0").get<double>();
  t.stiffness = j.at("cz").get<double>();
  return t;
}

double tmeasy_worst = 0.0;  ///< of all rows, as part of the value
/// The table has ten digits: half of the last one is at most 5e-10 of the value.
void expect_tmeasy_digits(double value, double expected, const std::string& what) {
  if (std::abs(expected) > 1e-3)
    tmeasy_worst = std::max(tmeasy_worst, std::abs(value / expected - 1.0));
  EXPECT_NEAR(value, expected, 5.001e-10 * std::abs(expected) + 1e-13) << what;
}

TEST(Tmeasy, MeetsTheReferenceTable) {
  int rows = 0;
  for (const test::NamedRow& row : test::named_rows("tyres/tmeasy/tmeasy.csv")) {
    Tmeasy t = tmeasy_of(row.name);
    const double load = row("Fz_N"), mu = row("mu_ratio");
    const double sx = row("sx"), sy = row("sy");
    const std::string what = row.name + " at " + std::to_string(row("Fz_N")) + " N";
    const auto f = tmeasy_forces(t, load, mu, sx, sy);
    expect_tmeasy_digits(f.Fx, row("Fx"), what);
    expect_tmeasy_digits(f.Fy, row("Fy"), what);
    expect_tmeasy_digits(f.trail, row("trail_over_L"), what);
    expect_tmeasy_digits(f.Mz, row("Mz"), what);
    EXPECT_LE(f.friction_use, 1.0 + 1e-12);
    t.normalised = false;
    const auto plain = tmeasy_forces(t, load, mu, sx, sy);
    expect_tmeasy_digits(plain.Fx, row("Fx_nonorm"), what);
    expect_tmeasy_digits(plain.Fy, row("Fy_nonorm"), what);
    ++rows;
  }
  EXPECT_EQ(rows, 184);
  std::printf("[ figure ] TMeasy rows %.3g\n", tmeasy_worst);
}

/// The outputs at load, friction, sx, sy.
template <class S>
std::array<S, 4> tmeasy_outputs(const Tmeasy& t, const std::array<S, 4>& x) {
  const auto f = tmeasy_forces<S>(t, x[0], x[1], x[2], x[3]);
  return {f.Fx, f.Fy, f.Mz, f.friction_use};
}

/// The central difference of steps h, h/2 and h/4 in one argument, extrapolated to h = 0.
std::array<double, 4> tmeasy_extrapolated(const Tmeasy& t, std::array<double, 4> x, std::size_t i,
                                          double h) {
  std::array<std::array<double, 4>, 3> d;
  const double at = x[i];
  for (double s = h; auto& row : d) {
    x[i] = at + s;
    const auto above = tmeasy_outputs(t, x);
    x[i] = at - s;
    const auto below = tmeasy_outputs(t, x);
    for (std::size_t k = 0; k < 4; ++k) row[k] = (above[k] - below[k]) / (2.0 * s);
    s /= 2.0;
  }
  std::array<double, 4> out;
  for (std::size_t k = 0; k < 4; ++k) {
    const double first = (4.0 * d[1][k] - d[0][k]) / 3.0, second = (4.0 * d[2][k] - d[1][k]) / 3.0;
    out[k] = (16.0 * second - first) / 15.0;
  }
  return out;
}

TEST(Tmeasy, DualsHaveTheDerivativesOfDifferences) {
  // Slips below the maximum, on both parabolas or the cubic, and sliding.
  const std::array<double, 2> slips[] = {{0.03, -0.02}, {-0.07, 0.04}, {0.01, 0.19},
                                         {0.3, -0.1},   {0.2, 0.5},    {-0.9, 1.5}};
  for (const std::string set : {"van", "cubic"})
    for (const bool normalised : {true, false})
      for (const auto& [sx, sy] : slips) {
        Tmeasy t = tmeasy_of(set);
        t.normalised = normalised;
        const std::array<double, 4> x = {1.3 * t.nominal_load, 0.83, sx, sy};
        std::array<Dual, 4> duals;
        for (int i = 0; i < 4; ++i) duals[i] = Dual::variable(x[i], i);
        const auto exact = tmeasy_outputs(t, duals);
        const auto values = tmeasy_outputs(t, x);
        for (std::size_t i = 0; i < 4; ++i) {
          const double size = i == 0 ? t.nominal_load : 1.0;
          const auto numeric = tmeasy_extrapolated(t, x, i, 2e-4 * size);
          for (std::size_t k = 0; k < 4; ++k) {
            const double unit = k == 3 ? 1.0 : t.nominal_load;
            EXPECT_EQ(exact[k].v, values[k]);
            EXPECT_NEAR(exact[k].d[static_cast<int>(i)] * size / unit, numeric[k] * size / unit,
                        1e-8)
                << set << " sx " << sx << " sy " << sy << " by " << i << " of " << k;
          }
        }
      }
}

TEST(Tmeasy, HasTheSlopesOfEachAxisAtZeroSlip) {
  for (const bool normalised : {true, false}) {
    Tmeasy t = tmeasy_of("van");
    t.normalised = normalised;
    const Dual load = 2500.0, mu = 0.7;
    const auto f = tmeasy_forces(t, load, mu, Dual::variable(0.0, 0), Dual::variable(0.0, 1));
    const double dx = tmeasy_slope(t, t.x, 2500.0), dy = tmeasy_slope(t, t.y, 2500.0);
    EXPECT_EQ(f.Fx.v, 0.0);
    EXPECT_EQ(f.Fy.v, 0.0);
    EXPECT_EQ(f.Mz.v, 0.0);
    EXPECT_NEAR(f.Fx.d[0] / dx, 1.0, 1e-6);
    EXPECT_NEAR(f.Fy.d[1] / dy, 1.0, 1e-6);
    EXPECT_NEAR(f.Fx.d[1], 0.0, 1e-9 * dx);
    EXPECT_NEAR(f.Fy.d[0], 0.0, 1e-9 * dx);
    EXPECT_TRUE((f.Mz.d.abs() < 1e5).all());
  }
}

TEST(Tmeasy, IsOddAndNeverDrives) {
  const Tmeasy t = tmeasy_of("van");
  for (double sx : {-3.0, -0.2, -0.01, 0.0, 0.05, 0.4})
    for (double sy : {-2.0, -0.1, 0.0, 0.02, 0.7}) {
      const auto f = tmeasy_forces(t, 3000.0, 1.0, sx, sy);
      const auto back = tmeasy_forces(t, 3000.0, 1.0, -sx, -sy);
      EXPECT_EQ(f.Fx, -back.Fx);
      EXPECT_EQ(f.Fy, -back.Fy);
      EXPECT_EQ(f.Mz, -back.Mz);
      EXPECT_GE(f.Fx * sx + f.Fy * sy, 0.0);
    }
}

TEST(Tmeasy, TablesAreHeldAboveTheLargestLoad) {
  const Tmeasy t = tmeasy_of("van");
  const auto at = tmeasy_forces(t, t.max_load, 1.0, 0.1, 0.2);
  const auto above = tmeasy_forces(t, 2.0 * t.max_load, 1.0, 0.1, 0.2);
  EXPECT_EQ(at.Fx, above.Fx);
  EXPECT_EQ(at.Fy, above.Fy);
  const auto lifted = tmeasy_forces(t, -1.0, 1.0, 0.1, 0.2);
  EXPECT_EQ(lifted.Fx, 0.0);
  EXPECT_EQ(lifted.Mz, 0.0);
}

}  // namespace
}  // namespace floatframe
