// Inertia integrals: rigid limits, convergence of the isoparametric approximation, point masses,
// mirror images.
#include "floatframe/body/fe_invariants.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "floatframe/body/mirrored.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "support/iltis_parts.hpp"
#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

TEST(FeInvariants, RigidBar) {
  const double L = 0.8, d = 0.05;
  const FeModel model = build_bar_frame(straight_bar(L, d, 3));
  const BeamSection s = BeamSection::solid_round(d);
  const double m = 7500.0 * s.A * L;
  const InertiaInvariants v = invariants_hermite(model, MatX::Zero(0, 0), true);
  EXPECT_NEAR(v.m, m, 1e-12);
  EXPECT_TRUE(v.centre_of_mass().isApprox(Vec3(0.4, 0, 0)));
  const Mat3 J = v.inertia_about_centre();
  EXPECT_NEAR(J(0, 0), 7500.0 * L * 2.0 * s.Iy, 1e-14);
  EXPECT_NEAR(J(1, 1), m * L * L / 12.0 + 7500.0 * L * s.Iy, 1e-12);
  EXPECT_EQ(v.modes(), 0);
  EXPECT_LT(relative_error(invariants_isoparametric(model, MatX()),
                           invariants_hermite(model, MatX(), false)),
            1e-13);
}

TEST(FeInvariants, PointMassWithRotaryInertia) {
  // A massless-looking bar with a flywheel: the integrals are those of a rigid particle with
  // inertia J that moves and turns with its node, compared as a difference of two bodies.
  FeModel model = build_bar_frame(straight_bar(0.8, 0.05, 3));
  Random random(1);
  const MatX X = random.matrix(6 * model.nodes(), 3);
  const InertiaInvariants without = invariants_hermite(model, X, true);
  const Mat3 R = random.rotation();
  const Mat3 J = R * Vec3(0.2, 0.3, 0.4).asDiagonal() * R.transpose();
  model.masses.push_back({2, 1.5, 0.5 * (J + J.transpose())});
  const InertiaInvariants with = invariants_hermite(model, X, true);
  const Mat3X Xn = X.middleRows(12, 3), Rn = X.middleRows(15, 3);
  EXPECT_NEAR(with.m - without.m, 1.5, 1e-12);
  const MatX M_ff = with.Sij[0][0] + with.Sij[1][1] + with.Sij[2][2] -
                    (without.Sij[0][0] + without.Sij[1][1] + without.Sij[2][2]);
  EXPECT_LT(relative_error(M_ff, 1.5 * Xn.transpose() * Xn + Rn.transpose() * J * Rn), 1e-12);
  const Vec3 p = model.positions[2];
  const Mat3 J_origin = with.inertia_about_origin() - without.inertia_about_origin();
  EXPECT_LT(relative_error(J_origin, J - 1.5 * skew(p) * skew(p)), 1e-12);
  // Coupling of rotation and modes at y = 0: int r x X dm = 1.5 p x X + J R.
  Mat3X F(3, 3);
  const auto S = [&](int i, int j) -> VecX {
    return (with.Si[i].row(j) - without.Si[i].row(j)).transpose();
  };
  F.row(0) = S(1, 2) - S(2, 1);
  F.row(1) = S(2, 0) - S(0, 2);
  F.row(2) = S(0, 1) - S(1, 0);
  EXPECT_LT(relative_error(F, 1.5 * skew(p) * Xn + J * Rn), 1e-12);
}

TEST(FeInvariants, SixRowMassEqualsExactIntegrals) {
  // M_ff from the consistent matrix and from the integrals.
  const FeModel model = build_bar_frame(a_arm_frame(5));
  Random random(2);
  const MatX X = random.matrix(6 * model.nodes(), 4);
  for (const bool section : {false, true}) {
    const InertiaInvariants v = invariants_hermite(model, X, section);
    const MatX M = X.transpose() * (assemble_mass(model, section, 6) * X);
    EXPECT_LT(relative_error(v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2], M), 1e-13);
  }
}

TEST(FeInvariants, IsoparametricConvergesWithTheSquareOfTheElementLength) {
  // Clamped beam, two static and two fixed-interface modes; differences relative to the largest
  // entry.
  double last[3] = {0, 0, 0};
  std::printf("elements   M          Qv         Sij\n");
  for (const int elements : {5, 10, 50, 100}) {
    const FeModel model = build_bar_frame(straight_bar(1.0, 0.03, elements));
    ReductionOptions options;
    options.clamped = {{"inner", all_dofs}};
    options.interfaces = {{"outer", 2u + 32u}};
    options.normal_modes = 2;
    options.mass_model = MassModel::hermite;
    const MatX X = craig_bampton_modes(model, options).X;
    const InertiaInvariants exact = invariants_hermite(model, X, false),
                            linear = invariants_isoparametric(model, X);
    Random random(3);
    const BodyState s = random_state(random, 4);
    MatX M[2] = {MatX(10, 10), MatX(10, 10)};
    VecX Q[2] = {VecX(10), VecX(10)};
    for (int i = 0; i < 2; ++i) {
      const PreprocessingData data(i == 0 ? exact : linear);
      PreprocessingWorkspace work(4);
      relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, M[i], Q[i]);
    }
    double Sij = 0.0, scale = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Sij = std::max(Sij, (exact.Sij[i][j] - linear.Sij[i][j]).cwiseAbs().maxCoeff());
        scale = std::max(scale, exact.Sij[i][j].cwiseAbs().maxCoeff());
      }
    }
    const double now[3] = {relative_error(M[1], M[0]), relative_error(Q[1], Q[0]), Sij / scale};
    std::printf("%8d   %.1e    %.1e    %.1e\n", elements, now[0], now[1], now[2]);
    for (int i = 0; i < 3; ++i) {
      if (elements == 100) {
        EXPECT_NEAR(std::log2(last[i] / now[i]), 2.0, 0.1) << i;
      }
      last[i] = now[i];
    }
  }
  EXPECT_LT(last[2], 2e-3);
}

TEST(Mirrored, SameAsReducingTheMirrorImage) {
  for (const MassModel mass_model : {MassModel::isoparametric, MassModel::six_dof}) {
    for (const Vec3& s : {Vec3(1, -1, 1), Vec3(-1, -1, 1), Vec3(-1, -1, -1)}) {
      const Mat3 P = s.asDiagonal();
      BarFrame frame = a_arm_frame(5);
      const auto options = [&](const FeModel& model, const MatX& basis) {
        ReductionOptions o;
        o.basis = basis;
        o.mass_model = mass_model;
        o.section_inertia = true;
        return reduce(model, o);
      };
      const FeModel model = build_bar_frame(frame);
      Random random(4);
      MatX X = random.matrix(6 * model.nodes(), 4);
      const FlexibleBody body = options(model, X);
      for (auto& [name, p] : frame.points) p = P * p;
      for (Bar& bar : frame.bars) bar.reference = P * bar.reference;
      for (int k = 0; k < model.nodes(); ++k) {
        X.middleRows(6 * k, 3) = P * X.middleRows(6 * k, 3);
        X.middleRows(6 * k + 3, 3) = s.prod() * P * X.middleRows(6 * k + 3, 3);
      }
      const FlexibleBody direct = options(build_bar_frame(frame), X);
      const FlexibleBody mirror = mirrored(body, P);
      EXPECT_LT(relative_error(mirror.invariants, direct.invariants), 1e-13);
      EXPECT_LT(relative_error(mirror.K, direct.K), 1e-13);
      for (std::size_t k = 0; k < direct.nodes.size(); ++k) {
        EXPECT_TRUE(mirror.nodes[k].p.isApprox(direct.nodes[k].p));
        EXPECT_EQ(mirror.nodes[k].X, direct.nodes[k].X);
        EXPECT_EQ(mirror.nodes[k].X_theta, direct.nodes[k].X_theta);
      }
      EXPECT_EQ(mirror.projection->X, direct.projection->X);
      if (mass_model == MassModel::six_dof) {
        EXPECT_LT(relative_error(MatX(mirror.projection->M_6), MatX(direct.projection->M_6)),
                  1e-13);
        EXPECT_EQ(mirror.projection->X_theta, direct.projection->X_theta);
      } else {
        EXPECT_LT(relative_error(MatX(mirror.projection->M_s), MatX(direct.projection->M_s)),
                  1e-13);
      }
      // Twice mirrored is the same body.
      EXPECT_EQ(mirrored(mirror, P).invariants.Sij[0][1], body.invariants.Sij[0][1]);
    }
  }
  EXPECT_THROW(mirrored(FlexibleBody{}, 2.0 * Mat3::Identity()), InputError);
}

}  // namespace
}  // namespace floatframe::test
