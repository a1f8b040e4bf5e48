// Lumped mass: of every element of the list, and against the analytic dispersion of a bar.
#include "floatframe/fe/lumped_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/dense.hpp"
#include "support/fe_models.hpp"
#include "support/fe_parts.hpp"
#include "support/quadratic_mesh.hpp"

namespace floatframe::test {
namespace {

FeModel lumped(FeModel model, MassForm form = MassForm::lumped) {
  for (FeElement& e : model.elements) e.mass_form = form;
  return model;
}

// Solids of first order keep mass and centre of mass, of second order the mass; no mass is
// negative, and none is off the diagonal.
TEST(LumpedMass, Solids) {
  FeModel bricks = brick_beam(2, 1, 1, 0.3, 0.1);
  for (Vec3& p : bricks.positions) p += 0.1 * Vec3(p.y() * p.z(), p.x() * p.y(), p.x() * p.z());
  for (const FeModel& model :
       {bricks, hex20_of(bricks), tets_of(bricks, false), tets_of(bricks, true)}) {
    const FeElementType type = model.elements[0].type;
    SCOPED_TRACE(fe_element_name(type));
    const MatX M = assemble_scalar_mass(model), D = assemble_scalar_mass(lumped(model));
    EXPECT_NEAR(D.sum() / M.sum(), 1.0, 1e-13);
    EXPECT_EQ((D - MatX(D.diagonal().asDiagonal())).norm(), 0.0);
    EXPECT_GT(D.diagonal().minCoeff(), 0.0);
    Vec3 exact = Vec3::Zero(), found = Vec3::Zero();
    for (int k = 0; k < model.nodes(); ++k) {
      exact += M.col(k).sum() * model.positions[k];
      found += D(k, k) * model.positions[k];
    }
    const double off = (found - exact).norm() / exact.norm();
    EXPECT_LT(off, quadratic(type) ? 1e-2 : 1e-14);
  }
}

// A bar held at one end: n linear elements with lumped mass stretch with w = 2 c/h sin((2 j - 1)
// pi/(4 n)), c^2 = E/rho.
TEST(LumpedMass, DispersionOfABar) {
  const int n = 8;
  const double L = 2.0, h = L / n;
  FeModel model;
  model.materials = {{2e11, 0.3, 7850}};
  model.sections = {BeamSection::rectangle(0.02, 0.03)};
  for (int k = 0; k <= n; ++k) model.positions.emplace_back(h * k, 0, 0);
  for (int k = 0; k < n; ++k)
    add_element(model, FeElementType::beam2, {k, k + 1}).mass_form =
        MassForm::lumped_without_rotation;
  validate(model);
  const FeSystem system = assemble(model);
  MatX K(n, n), M(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      K(i, j) = system.K.coeff(6 * i + 6, 6 * j + 6);
      M(i, j) = system.M.coeff(6 * i + 6, 6 * j + 6);
    }
  const VecX w = generalised_eigen(K, M).values.cwiseSqrt();
  for (int j = 1; j <= n; ++j)
    EXPECT_NEAR(w(j - 1) / (2 * std::sqrt(2e11 / 7850) / h *
                            std::sin((2 * j - 1) * std::numbers::pi / (4 * n))),
                1.0, 1e-12);
  // The inertia integrals are those of masses at the nodes: moments larger by rho A L h^2/6.
  const FeSystem all = assemble(model);
  const PointModel points = point_model(model, all);
  const double m = 7850 * 0.02 * 0.03 * L;
  EXPECT_EQ(points.anisotropy, 0.0);
  double mass = 0.0, square = 0.0;  // x^2 + z^2; in the direction of y rotary inertia counts too
  for (int k = 0; k < points.M_s.outerSize(); ++k)
    for (SparseRows::InnerIterator it(points.M_s, k); it; ++it) {
      mass += it.value();
      square += it.value() *
                (points.p(0, k) * points.p(0, it.col()) + points.p(2, k) * points.p(2, it.col()));
    }
  EXPECT_NEAR(mass / m, 1.0, 1e-12);
  EXPECT_NEAR(square / (m * (L * L / 3 + h * h / 6)), 1.0, 1e-12);
}

}  // namespace
}  // namespace floatframe::test
