// Shear deformation of 2-node beams against Timoshenko's theory.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"
#include "support/fe_models.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

constexpr double half_turn = std::numbers::pi;

/// A stubby bar along x, local y along body y, with different shear areas.
FeModel stubby(int elements, double L) {
  FeModel model;
  model.materials = {{2e11, 0.3, 7850}};
  model.sections = {BeamSection::rectangle(0.06, 0.1)};
  model.sections[0].shear_y = 0.8 * model.sections[0].A;
  model.sections[0].shear_z = 0.5 * model.sections[0].A;
  for (int k = 0; k <= elements; ++k) model.positions.emplace_back(L * k / elements, 0, 0);
  for (int k = 0; k < elements; ++k)
    add_element(model, FeElementType::beam2, {k, k + 1}).reference = Vec3::UnitY();
  validate(model);
  return model;
}

// Tip force and tip moment of a cantilever, with one element and with three.
TEST(Timoshenko, CantileverIsExact) {
  const double L = 0.3;
  for (const int elements : {1, 3}) {
    const FeModel model = stubby(elements, L);
    const BeamSection& s = model.sections[0];
    const double E = 2e11, G = model.materials[0].shear();
    const int tip = 6 * elements;
    for (const bool z : {false, true}) {
      VecX f = VecX::Zero(tip + 6);
      f(tip + (z ? 2 : 1)) = 1.0;
      const double EI = E * (z ? s.Iy : s.Iz), GA = G * (z ? s.shear_z : s.shear_y);
      const VecX u = solve(model, {{0, 63}}, f);
      EXPECT_NEAR(u(tip + (z ? 2 : 1)) / (L * L * L / (3 * EI) + L / GA), 1.0, 1e-9);
      EXPECT_NEAR(u(tip + (z ? 4 : 5)) / ((z ? -1 : 1) * L * L / (2 * EI)), 1.0, 1e-9);
      f.setZero();
      f(tip + (z ? 4 : 5)) = z ? -1.0 : 1.0;
      EXPECT_NEAR(solve(model, {{0, 63}}, f)(tip + (z ? 2 : 1)) / (L * L / (2 * EI)), 1.0, 1e-9);
    }
  }
}

// The element of linear shapes with one point and the slenderness compensation of Abaqus, from its
// strains: kappa = (ry_2 - ry_1)/L, gamma = (v_2 - v_1)/L - (rz_1 + rz_2)/2.
TEST(Timoshenko, LinearShapesAsAbaqusHasThem) {
  for (const double L : {0.02, 0.3, 5.0}) {
    FeModel model = stubby(1, L);
    BeamSection& s = model.sections[0];
    s.slenderness = 0.25;
    MatX K;
    element_kernel(FeElementType::beam2).stiffness(gather(model, model.elements[0]), K);
    for (const bool z : {false, true}) {
      const double E = 2e11, I = z ? s.Iy : s.Iz, sign = z ? -1.0 : 1.0;
      const double S = model.materials[0].shear() * (z ? s.shear_z : s.shear_y) /
                       (1 + 0.25 * L * L * s.A / (12 * I));
      const int dofs[4] = {z ? 2 : 1, z ? 4 : 5, z ? 8 : 7, z ? 10 : 11};
      const Eigen::RowVector4d kappa(0, -sign / L, 0, sign / L);
      const Eigen::RowVector4d gamma(-1 / L, -sign / 2, 1 / L, -sign / 2);
      const Eigen::Matrix4d expected =
          L * (E * I * kappa.transpose() * kappa + S * gamma.transpose() * gamma);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          EXPECT_NEAR(K(dofs[i], dofs[j]), expected(i, j),
                      1e-12 * std::abs(expected(1, 1)) / std::min(1.0, L * L))
              << L << " " << i << " " << j;
    }
  }
}

/// Lowest root of rho^2 I A/(G As) w^4 - (rho A + rho I k^2 + rho A E I k^2/(G As)) w^2 + E I k^4.
double analytic(const Material& m, double A, double I, double As, double k) {
  const double GA = m.shear() * As, rho = m.density, EI = m.young * I;
  const double a = rho * rho * I * A / GA, c = EI * std::pow(k, 4);
  const double b = rho * A + rho * I * k * k + rho * A * EI * k * k / GA;
  return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c)));
}

/// Rows of bending in a plane, with both ends supported.
std::vector<int> supported_rows(const FeModel& model, const FeSystem& system, bool z) {
  std::vector<int> rows;
  for (int k = 0; k < model.nodes(); ++k) {
    if (k > 0 && k + 1 < model.nodes()) rows.push_back(system.row(k, z ? 2 : 1));
    rows.push_back(system.row(k, z ? 4 : 5));
  }
  return rows;
}

/// Frequencies of bending in a plane, with both ends supported.
VecX supported(const FeModel& model, bool z) {
  const FeSystem system = assemble(model);
  const std::vector<int> rows = supported_rows(model, system, z);
  const MatX K = MatX(system.K)(rows, rows), M = MatX(system.M)(rows, rows);
  return generalised_eigen(K, M).values.cwiseSqrt();
}

// A bar five times as long as it is high: frequencies converge to the analytic ones with the square
// of the length of the elements: shear is constant in each.
TEST(Timoshenko, FrequenciesOfASupportedBar) {
  const double L = 0.5;
  for (const bool z : {false, true}) {
    const FeModel coarse = stubby(16, L), fine = stubby(32, L);
    const BeamSection& s = coarse.sections[0];
    const VecX w16 = supported(coarse, z), w32 = supported(fine, z);
    for (int n = 1; n <= 3; ++n) {
      const double w = analytic(coarse.materials[0], s.A, z ? s.Iy : s.Iz,
                                z ? s.shear_z : s.shear_y, n * half_turn / L);
      const double e16 = w16(n - 1) / w - 1.0, e32 = w32(n - 1) / w - 1.0;
      EXPECT_LT(std::abs(e32), (n == 1 ? 6e-5 : n == 2 ? 6.2e-4 : 2.1e-3)) << n;
      EXPECT_NEAR(std::log2(e16 / e32), 2.0, 0.05) << n;
    }
    // Without shear they are far off: the test can tell.
    FeModel rigid = fine;
    rigid.sections[0].shear_y = rigid.sections[0].shear_z = 0.0;
    EXPECT_GT(supported(rigid, z)(0) / w32(0), 1.015);
  }
}

/// Lowest load of a supported column.
double buckling_load(const FeModel& model, bool z) {
  const BeamSection& s = model.sections[0];
  const FeSystem system = assemble(model);
  MatX Kg = MatX::Zero(system.size(), system.size());
  std::vector<StressedPoint> points;
  for (const FeElement& e : model.elements) {
    const ElementInput in = gather(model, e);
    element_kernel(e.type).stressed_points(in, points);
    VecX u = VecX::Zero(12);
    u(6) = -(in.p[1] - in.p[0]).norm() / (2e11 * s.A);  // compressed by one newton
    for (const StressedPoint& p : points) {
      const Vec6 stress = p.stress * u;
      Mat3 S;
      S << stress(0), stress(3), stress(5), stress(3), stress(1), stress(4), stress(5), stress(4),
          stress(2);
      for (int i = 0; i < 3; ++i) {
        const MatX g = p.gradient.middleRows<3>(3 * i);
        Kg.block<12, 12>(6 * e.nodes[0], 6 * e.nodes[0]) += g.transpose() * S * g;
      }
    }
  }
  const std::vector<int> rows = supported_rows(model, system, z);
  const MatX K = MatX(system.K)(rows, rows), G = -Kg(rows, rows);
  // K x = P G x with K > 0: the largest 1/P.
  return 1.0 / generalised_eigen(G, K).values.tail(1)(0);
}

// Engesser's load P = Pe/(1 + Pe/(G As)), from the axial force times the slopes of the centre line
// squared: order two as well.
TEST(Timoshenko, BucklingLoad) {
  const double L = 0.5;
  const FeModel coarse = stubby(16, L), fine = stubby(32, L);
  const BeamSection& s = fine.sections[0];
  for (const bool z : {false, true}) {
    const double Pe = half_turn * half_turn * 2e11 * (z ? s.Iy : s.Iz) / (L * L);
    const double P = Pe / (1 + Pe / (fine.materials[0].shear() * (z ? s.shear_z : s.shear_y)));
    const double e16 = buckling_load(coarse, z) / P - 1, e32 = buckling_load(fine, z) / P - 1;
    EXPECT_LT(std::abs(e32), 1.1e-4);
    EXPECT_NEAR(std::log2(e16 / e32), 2.0, 0.05);
  }
}

}  // namespace
}  // namespace floatframe::test
