// The Calspan law with the data of the Iltis against the values of a public program.
#include "floatframe/tyres/calspan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "support/named_rows.hpp"

namespace floatframe {
namespace {

constexpr double calspan_degree = std::numbers::pi / 180.0;
const Calspan iltis_calspan = {.A0 = 2625.0,
                               .A1 = 14.47,
                               .A2 = 12930.0,
                               .A3 = 2.29,
                               .A4 = 18175.0,
                               .load_limit = 1.0,
                               .B1 = -4.64e-5,
                               .B3 = 1.216,
                               .B4 = 2.18e-11,
                               .SN = 1.0274,
                               .AF1 = -1.71e-5,
                               .AF2 = 1.71e-5};

TEST(Calspan, MeetsTheReferenceTable) {
  int rows = 0;
  double worst = 0.0;
  for (const test::NamedRow& row : test::named_rows("tyres/calspan/calspan.csv")) {
    const auto f =
        calspan_forces(iltis_calspan, std::stod(row.name), 1.0, row("alpha_deg") * calspan_degree,
                       row("gamma_deg") * calspan_degree);
    // The table has nine digits.
    const double Fy = row("Fy_N"), Mz = row("Mz_Nm");
    EXPECT_NEAR(f.Fy, Fy, 5e-9 * std::max(1.0, std::abs(Fy)));
    EXPECT_NEAR(f.Mz, Mz, 5e-9 * std::max(1.0, std::abs(Mz)));
    EXPECT_LE(f.friction_use, 1.0);
    worst = std::max({worst, std::abs(f.Fy - Fy) / std::max(1.0, std::abs(Fy)),
                      std::abs(f.Mz - Mz) / std::max(1.0, std::abs(Mz))});
    ++rows;
  }
  EXPECT_EQ(rows, 108);
  std::printf("[ figure ] Calspan rows %.3g\n", worst);
}

TEST(Calspan, DualsHaveTheDerivativesOfDifferences) {
  // Below and above the limit of the load, sliding, and where the polynomial mu is negative.
  for (const double load : {500.0, 3830.0, 9000.0, 14000.0, 33000.0})
    for (const double alpha : {-0.3, -0.06, 0.0, 0.01, 0.11})
      for (const double gamma : {-0.05, 0.0, 0.04}) {
        const auto f = [&](double l, double a, double g) {
          return calspan_forces(iltis_calspan, l, 0.9, a, g);
        };
        const auto exact = calspan_forces(iltis_calspan, Dual::variable(load, 0), 0.9,
                                          Dual::variable(alpha, 1), Dual::variable(gamma, 2));
        const double x[] = {load, alpha, gamma};
        for (int i = 0; i < 3; ++i) {
          const double size = i == 0 ? load : 1.0;
          double d_Fy[2], d_Mz[2];
          for (int k = 0; k < 2; ++k) {
            const double h = (k == 0 ? 1e-4 : 5e-5) * size;
            double up[3], down[3];
            std::copy(x, x + 3, up), std::copy(x, x + 3, down);
            up[i] += h, down[i] -= h;
            const auto above = f(up[0], up[1], up[2]);
            const auto below = f(down[0], down[1], down[2]);
            d_Fy[k] = (above.Fy - below.Fy) / (2.0 * h);
            d_Mz[k] = (above.Mz - below.Mz) / (2.0 * h);
          }
          // At no slip the curvature of f jumps, so that differences converge with h.
          const double tolerance = alpha == 0.0 && gamma == 0.0 ? 1e-2 : 1e-8;
          EXPECT_NEAR(exact.Fy.d[i] * size / load, (4.0 * d_Fy[1] - d_Fy[0]) / 3.0 * size / load,
                      tolerance)
              << load << " " << alpha << " " << gamma << " by " << i;
          EXPECT_NEAR(exact.Mz.d[i] * size / load, (4.0 * d_Mz[1] - d_Mz[0]) / 3.0 * size / load,
                      tolerance)
              << load << " " << alpha << " " << gamma << " by " << i;
        }
      }
}

TEST(Calspan, HasTheStiffnessesOfTheDataSheetAtNoSlip) {
  const auto f = calspan_forces(iltis_calspan, Dual(3830.0), 1.0, Dual::variable(0.0, 0),
                                Dual::variable(0.0, 1));
  EXPECT_NEAR(f.Fy.d[0], -calspan_cornering_stiffness(iltis_calspan, 3830.0), 1e-9);
  EXPECT_NEAR(f.Fy.d[1], -calspan_camber_stiffness(iltis_calspan, 3830.0), 1e-9);
  // The linear tyre of the benchmark at 20 m/s: front 41641 and 6925, rear 40162 and 6600 N/rad.
  EXPECT_NEAR(calspan_cornering_stiffness(iltis_calspan, 3830.8), 41641.0, 15.0);
  EXPECT_NEAR(calspan_camber_stiffness(iltis_calspan, 3830.8), 6925.0, 5.0);
}

TEST(Calspan, IsNothingWithoutLoad) {
  const auto f = calspan_forces(iltis_calspan, -10.0, 1.0, 0.1, 0.1);
  EXPECT_EQ(f.Fy, 0.0);
  EXPECT_EQ(f.Mz, 0.0);
}

}  // namespace
}  // namespace floatframe
