// Whirl of a rotor that is a part: an overhung shaft of beams with discs that turns about its axis,
// in the rotating frame of the body, against the same elements assembled in axes at rest with their
// gyroscopic moments. All modes are kept, so both are the same to rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"
#include "support/fe_models.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

constexpr int shaft_elements = 6;

Mat3 disc(double polar, double diametral) { return Vec3(polar, diametral, diametral).asDiagonal(); }

/// A disc in the middle and one on a rigid arm beyond the end.
FeModel overhung(bool with_shear, MassForm form) {
  FeModel model;
  model.materials = {steel};
  model.sections = {BeamSection::solid_round(0.06)};
  BeamSection& s = model.sections[0];
  if (with_shear) s.shear_y = s.shear_z = 0.9 * s.A;
  for (int k = 0; k <= shaft_elements; ++k) model.positions.emplace_back(0.1 * k, 0.0, 0.0);
  for (int k = 0; k < shaft_elements; ++k)
    add_element(model, FeElementType::beam2, {k, k + 1}).mass_form = form;
  model.masses.push_back({3, 20.0, disc(0.3, 0.16)});
  add_spider(model, shaft_elements, {model.nodes()});
  model.positions.emplace_back(0.67, 0.0, 0.0);
  model.masses.push_back({model.nodes() - 1, 8.0, disc(0.1, 0.06)});
  return model;
}

PartOptions clamped_shaft(const FeModel& model) {
  PartOptions options;
  options.interfaces = {interface_at("A", nearest_to(model.positions[0]))};
  options.reference = {BodyReference::Kind::node, "A"};
  options.modes = 6 * shaft_elements;
  options.check_free_modes = false;
  options.stresses = false;
  return options;
}

/// Eigenvalues of M q'' + G q' + K q = 0 on the imaginary axis, ascending, positive.
std::vector<double> whirl_frequencies(const MatX& M, const MatX& G, const MatX& K) {
  const Eigen::Index n = M.rows();
  MatX A = MatX::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -lu_solve(M, K);
  A.bottomRightCorner(n, n) = -lu_solve(M, G);
  const GeneralEigen eigen = general_eigen(A);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    EXPECT_LT(std::abs(eigen.values(k).real()), 1e-6 * std::abs(eigen.values(k)) + 1e-3);
    if (eigen.values(k).imag() > 0.0) out.push_back(eigen.values(k).imag());
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// T = 1/2 polar W (theta_z theta_y' - theta_y theta_z') of a rotation with rows theta.
void add_gyroscopic(double polar, const MatX& theta, MatX& G) {
  const MatX half = theta.row(1).transpose() * theta.row(2);
  G += polar * (half - half.transpose());
}

/// The shaft in axes at rest: gyroscopic matrix of unit speed, all degrees of freedom.
MatX gyroscopic(const FeModel& model, const FeSystem& system) {
  MatX G = MatX::Zero(system.size(), system.size());
  std::vector<MassStation> stations;
  for (const FeElement& e : model.elements) {
    const ElementInput in = gather(model, e);
    if (e.mass_form == MassForm::lumped) {
      const BeamSection& s = in.section;
      const double polar = 0.5 * in.material.density * 0.1 * (s.Iy + s.Iz);
      for (int k = 0; k < 2; ++k)
        add_gyroscopic(
            polar, MatX(system.T_theta.middleRows(3 * e.nodes[static_cast<std::size_t>(k)], 3)), G);
      continue;
    }
    beam2_kernel.mass_stations(in, stations);
    for (const MassStation& station : stations) {
      MatX theta = MatX::Zero(3, system.size());
      for (int k = 0; k < 2; ++k) {
        const int node = e.nodes[static_cast<std::size_t>(k)];
        theta += station.theta.middleCols<3>(6 * k) * system.T.middleRows(3 * node, 3);
        theta += station.theta.middleCols<3>(6 * k + 3) * system.T_theta.middleRows(3 * node, 3);
      }
      add_gyroscopic(station.moments.sum(), theta, G);
    }
  }
  // The disc on the arm turns with the end.
  for (const PointMass& m : model.masses) {
    const int node = std::min(m.node, shaft_elements);
    add_gyroscopic(m.J(0, 0), MatX(system.T_theta.middleRows(3 * node, 3)), G);
  }
  return G;
}

/// In axes at rest, the first node held.
std::vector<double> whirl_at_rest(const FeModel& model, double speed) {
  const FeSystem system = assemble(model);
  const Eigen::Index free = system.size() - 6;
  const MatX K = MatX(system.K).bottomRightCorner(free, free);
  const MatX M = MatX(system.M).bottomRightCorner(free, free);
  const MatX G = gyroscopic(model, system).bottomRightCorner(free, free);
  return whirl_frequencies(M, speed * G, K);
}

void expect_whirl(const FeModel& model, double speed) {
  const std::vector<double> rest = whirl_at_rest(model, speed);

  const FlexibleBody body = reduce_part(model, clamped_shaft(model)).body;
  ASSERT_TRUE(body.turning);
  const auto& S = body.invariants.Sij;
  const auto& h = body.turning->S2i;
  const MatX D = S[1][2] - S[2][1] + h[1][2] - h[2][1];
  MatX C = S[1][1] + S[2][2] + h[1][1] + h[2][2];
  // Stiffening has no share in it: no load of a spin about the axis pulls the shaft.
  const MatX stiffening = body.second_order->S2i[1][1] + body.second_order->S2i[2][2];
  EXPECT_LT(stiffening.norm(), 1e-9 * C.norm());
  const std::vector<double> turning = whirl_frequencies(
      modal_mass(body.invariants), speed * (D.transpose() - D), body.K - speed * speed * C);
  // Whirl at w in axes at rest is seen at |w - speed| or |w + speed| in those of the body.
  for (std::size_t k = 0; k < 8; ++k) {
    double nearest = 1.0;
    for (const double f : turning)
      for (const double sign : {1.0, -1.0})
        for (const double seen : {rest[k] + sign * speed, rest[k]})
          nearest = std::min(nearest, std::abs(f / std::abs(seen) - 1.0));
    EXPECT_LT(nearest, 1e-8) << k << " " << rest[k];
  }
}

TEST(RotorParts, WhirlOfAnOverhungShaft) {
  for (const double speed : {0.0, 300.0, 1000.0}) {
    expect_whirl(overhung(false, MassForm::consistent), speed);
    expect_whirl(overhung(true, MassForm::consistent), speed);
    expect_whirl(overhung(false, MassForm::lumped), speed);
  }
}

// At the speeds above the gyroscopic moments are not small.
TEST(RotorParts, TheOrderOfTheEffect) {
  const FeModel model = overhung(false, MassForm::consistent);
  const std::vector<double> still = whirl_at_rest(model, 0.0), spun = whirl_at_rest(model, 1000.0);
  EXPECT_GT(spun[1] / still[1], 1.1);
  EXPECT_LT(spun[0] / still[0], 0.9);
}

}  // namespace
}  // namespace floatframe::test
