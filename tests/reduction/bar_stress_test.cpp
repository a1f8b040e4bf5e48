// Section forces and stress of frames of bars against statics of beams.
#include "floatframe/reduction/bar_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/mirrored.hpp"
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe::test {
namespace {

constexpr double rod_length = 1.2, density = 7850.0;

/// A bar from the origin along x, clamped there, `modes` fixed-interface modes and a free end.
FeModel rod_model(int elements, const BeamSection& section) {
  BarFrame frame;
  frame.material = {2.1e11, 0.3, density};
  frame.points = {{"root", Vec3::Zero()}, {"tip", Vec3(rod_length, 0, 0)}};
  Bar bar;
  bar.name = "rod";
  bar.from = "root";
  bar.to = "tip";
  bar.elements = elements;
  bar.section = section;
  bar.reference = Vec3::UnitY();
  frame.bars = {bar};
  return build_bar_frame(frame);
}

FlexibleBody rod(int elements, const BeamSection& section, int modes, bool interface,
                 bool orthonormal = false, MassModel mass = MassModel::hermite) {
  ReductionOptions options;
  options.clamped = {{"root", all_dofs}};
  if (interface) options.interfaces = {{"tip", all_dofs}};
  options.normal_modes = modes;
  options.mass_model = mass;
  options.section_inertia = mass != MassModel::isoparametric;
  options.orthonormalise = orthonormal;
  return reduce(rod_model(elements, section), options);
}

/// Coefficients of accelerations a + skew(alpha) r + skew(w)^2 r.
VecX coefficients(const FlexibleBody& body, const Vec3& a, const Vec3& alpha, const Vec3& w) {
  VecX c = VecX::Zero(body_load_cases + body.modes());
  c.head<3>() = -a;
  const Mat3 A = skew(alpha) + skew(w) * skew(w);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(3 + 3 * i + j) = -A(j, i);
  return c;
}

/// Quasi-static amplitudes under the body's own loads, from its inertia integrals.
VecX amplitudes(const FlexibleBody& body, const VecX& c) {
  const InertiaInvariants& v = body.invariants;
  VecX f = v.S.transpose() * c.head<3>();
  for (int i = 0; i < 3; ++i) f += v.Si[i].transpose() * c.segment<3>(3 + 3 * i);
  return ldlt_solve(body.K, MatX(f)).col(0);
}

TEST(BarStress, CantileverUnderTipLoads) {
  const BeamSection s = BeamSection::rectangle(0.02, 0.04);
  const FlexibleBody body = rod(6, s, 2, true);
  const ModalNode& tip = body.nodes.back();
  const Vec3 F(300.0, 20.0, -50.0), M(4.0, 3.0, -2.0);
  const VecX f = tip.X.transpose() * F + tip.X_theta.transpose() * M;
  const VecX y = ldlt_solve(body.K, MatX(f)).col(0);
  const BodyStress& stress = *body.stress;
  ASSERT_EQ(stress.sections.size(), 12u);
  const VecX forces = stress.section_modes * y, values = stress.modes * y;
  for (std::size_t k = 0; k < 12; ++k) {
    const double x = body.nodes[stress.sections[k].node].p(0), arm = rod_length - x;
    Vec6 expected;
    expected << F, M(0), M(1) - arm * F(2), M(2) + arm * F(1);
    EXPECT_LT((forces.segment<6>(6 * static_cast<Eigen::Index>(k)) - expected).norm(),
              1e-8 * expected.norm());
    if (k > 0) continue;
    // At the root: the axis and the corner with the largest stress, by hand.
    double largest = 0.0;
    for (int p = stress.first_place[0]; p < stress.first_place[1]; ++p)
      largest = std::max(largest, std::abs(values(6 * p)));
    const double by_hand =
        F(0) / s.A + std::abs(expected(4)) * 0.02 / s.Iy + std::abs(expected(5)) * 0.01 / s.Iz;
    std::printf("[ figure ] root of the cantilever: %.6g MPa, beam theory %.6g MPa\n",
                1e-6 * largest, 1e-6 * by_hand);
    EXPECT_NEAR(largest, by_hand, 1e-9 * by_hand);
  }
}

// density W^2 (L^2 - x^2) / 2, whatever the axial modes have of it.
TEST(BarStress, TurningRod) {
  const BeamSection s = BeamSection::solid_round(0.03);
  const double W = 80.0;
  for (const int modes : {1, 4, 12}) {
    const FlexibleBody body = rod(10, s, modes, false);
    const VecX c = coefficients(body, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, W));
    const VecX y = amplitudes(body, c);
    const BodyStress& stress = *body.stress;
    const VecX by_modes = stress.modes * y, all = by_modes + stress.loads * c;
    const double root = 0.5 * density * W * W * rod_length * rod_length;
    for (const StressPlace& place : stress.places) {
      const Eigen::Index row = 6 * (&place - stress.places.data());
      const double x = body.nodes[place.node].p(0);
      EXPECT_NEAR(all(row), root - 0.5 * density * W * W * x * x, 1e-6 * root) << modes;
    }
    std::printf(
        "[ figure ] turning rod, %d modes: root %.4f of the closed form by modes alone, "
        "%.9f with loads\n",
        modes, by_modes(0) / root, all(0) / root);
  }
}

// Weight, angular acceleration, with and without an interface, orthonormal modes: bending moments
// of a cantilever under q = density A (a + alpha x).
TEST(BarStress, BendingByAcceleration) {
  const BeamSection s = BeamSection::rectangle(0.02, 0.03);
  const double a = 9.81, alpha = 30.0;
  for (const MassModel mass : {MassModel::hermite, MassModel::isoparametric, MassModel::six_dof})
    for (const bool interface : {false, true}) {
      const bool orthonormal = mass != MassModel::six_dof && !interface;
      const FlexibleBody body = rod(5, s, 3, interface, orthonormal, mass);
      // Acceleration -a along z, and alpha about y: -alpha x along z.
      const VecX c = coefficients(body, Vec3(0, 0, -a), Vec3(0, alpha, 0), Vec3::Zero());
      const VecX y = amplitudes(body, c);
      const VecX forces = body.stress->section_modes * y + body.stress->section_loads * c;
      const double q = density * s.A;
      for (const BeamSectionPlace& section : body.stress->sections) {
        const Eigen::Index row = 6 * (&section - body.stress->sections.data());
        const double x = body.nodes[section.node].p(0), L = rod_length;
        // Loads +q (a + alpha x) along z outside of x.
        const double V = q * (a * (L - x) + 0.5 * alpha * (L * L - x * x));
        const double M = -q * (0.5 * a * (L - x) * (L - x) +
                               alpha * (L * L * L / 3 - x * L * L / 2 + x * x * x / 6));
        const double root = q * (a * L * L / 2 + alpha * L * L * L / 3);
        EXPECT_NEAR(forces(row + 2), V, 1e-6 * root / L);
        // The section's own rotary inertia, density I alpha (L - x), is part of it.
        const double rotary =
            mass == MassModel::isoparametric ? 0.0 : density * s.Iy * alpha * (L - x);
        EXPECT_NEAR(forces(row + 4), M - rotary, 1e-6 * root);
      }
    }
}

// The mirrored body under mirrored loads.
TEST(BarStress, MirroredBodies) {
  const FlexibleBody body = rod(4, BeamSection::rectangle(0.02, 0.03), 3, true);
  const Mat3 P = Vec3(1.0, -1.0, 1.0).asDiagonal();
  const FlexibleBody other = mirrored(body, P);
  const Vec3 a(1.0, 2.0, 3.0), alpha(10.0, 20.0, 30.0), w(4.0, 5.0, 6.0);
  VecX c = coefficients(body, a, alpha, w), d = coefficients(other, P * a, -P * alpha, -P * w);
  c.tail(body.modes()).setLinSpaced(0.1, 0.7);
  d.tail(body.modes()) = c.tail(body.modes());
  const VecX y = VecX::LinSpaced(body.modes(), 1e-4, 3e-4);
  const VecX left = body.stress->modes * y + body.stress->loads * c;
  const VecX right = other.stress->modes * y + other.stress->loads * d;
  for (Eigen::Index k = 0; k < left.size() / 6; ++k) {
    Vec6 expected = left.segment<6>(6 * k);
    expected(3) *= -1.0;
    expected(4) *= -1.0;
    EXPECT_LT((right.segment<6>(6 * k) - expected).norm(), 1e-9 * left.norm());
    EXPECT_EQ(other.stress->places[k].p, P * body.stress->places[k].p);
  }
  const VecX f = body.stress->section_modes * y + body.stress->section_loads * c;
  const VecX g = other.stress->section_modes * y + other.stress->section_loads * d;
  const Vec6 signs = (Vec6() << 1, 1, -1, -1, -1, 1).finished();
  for (Eigen::Index k = 0; k < f.size() / 6; ++k)
    EXPECT_LT((g.segment<6>(6 * k) - signs.cwiseProduct(f.segment<6>(6 * k))).norm(),
              1e-9 * f.norm());
}

}  // namespace
}  // namespace floatframe::test
