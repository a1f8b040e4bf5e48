// Two independent computations of every inertia term on random states: projection and
// preprocessing, absolute and relative coordinates, no modes and rigid-body formulas; no heap in
// step time.
#include <gtest/gtest.h>

#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/allocation_counter.hpp"
#include "support/iltis_parts.hpp"
#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

constexpr double tolerance = 1e-13;  // of the largest entry

struct Case {
  std::string name;
  FlexibleBody body;
};

FlexibleBody random_basis(const FeModel& model, int modes, MassModel mass_model, unsigned seed) {
  Random random(seed);
  ReductionOptions options;
  options.basis = random.matrix(model.nodes() * model.dofs_per_node(), modes);
  options.mass_model = mass_model;
  options.section_inertia = mass_model != MassModel::isoparametric;
  return reduce(model, options);
}

std::vector<Case> isoparametric_bodies() {
  std::vector<Case> cases;
  for (const int modes : {0, 1, 4, 7, 16}) {
    cases.push_back(
        {"arm " + std::to_string(modes),
         random_basis(build_bar_frame(a_arm_frame(5)), modes, MassModel::isoparametric, 11)});
  }
  cases.push_back(
      {"hex8", random_basis(to_model(reference_body("hex8")), 6, MassModel::isoparametric, 12)});
  cases.push_back(
      {"tet4", random_basis(to_model(reference_body("tet4")), 5, MassModel::isoparametric, 13)});
  cases.push_back({"arm reduced", reduce(build_bar_frame(a_arm_frame(10)), a_arm_options())});
  FeModel with_mass = build_bar_frame(a_arm_frame(5));
  with_mass.masses.push_back({3, 1.7, Mat3::Zero()});
  cases.push_back({"point mass", random_basis(with_mass, 4, MassModel::isoparametric, 14)});
  return cases;
}

TEST(InertiaConsistency, ProjectionEqualsPreprocessing) {
  Random random(1);
  for (const Case& c : isoparametric_bodies()) {
    SCOPED_TRACE(c.name);
    const int nm = c.body.modes();
    const PreprocessingData p_data(c.body.invariants);
    PreprocessingWorkspace p_work(nm);
    ProjectionWorkspace b_work(*c.body.projection);
    MatX Mp(12 + nm, 12 + nm), Mb(12 + nm, 12 + nm), Rp(6 + nm, 6 + nm), Rb(6 + nm, 6 + nm);
    VecX Qp(12 + nm), Qb(12 + nm), qp(6 + nm), qb(6 + nm);
    for (int i = 0; i < 10; ++i) {
      BodyState s = random_state(random, nm);
      relative_preprocessing(p_data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), p_work, Rp, qp);
      relative_projection(*c.body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), b_work,
                          Rb, qb);
      EXPECT_LT(relative_error(Rp, Rb), tolerance);
      EXPECT_LT(relative_error(qp, qb), tolerance);
      EXPECT_EQ(Rp, Rp.transpose());
      EXPECT_EQ(Rb, Rb.transpose());
      if (i % 2 == 1) {  // A need not be orthonormal, nor A^T Adot skew
        s.A += random.matrix(3, 3, 0.1);
        s.Adot += random.matrix(3, 3, 0.5);
      }
      absolute_preprocessing(p_data, s.A, s.Adot, s.y.data(), s.ydot.data(), p_work, Mp, Qp);
      absolute_projection(*c.body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), b_work, Mb,
                          Qb);
      EXPECT_LT(relative_error(Mp, Mb), tolerance);
      EXPECT_EQ(Mp, Mp.transpose());
      if (nm > 0) {
        EXPECT_LT(relative_error(Qp, Qb), tolerance);
      } else {
        EXPECT_EQ(Qp.cwiseAbs().maxCoeff(), 0.0);
        EXPECT_EQ(Qb.cwiseAbs().maxCoeff(), 0.0);
      }
    }
  }
}

/// M_rel = T' M_abs T and Qv_rel = T' (Qv_abs - M_abs b), b the bias of the absolute coordinates.
template <class Absolute, class Relative>
void check_coordinate_sets(int nm, Random& random, Absolute absolute, Relative relative,
                           double limit) {
  MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm);
  VecX Qa(12 + nm), Qr(6 + nm);
  for (int i = 0; i < 10; ++i) {
    const BodyState s = random_state(random, nm);
    absolute(s, Ma, Qa);
    relative(s, Mr, Qr);
    const MatX T = absolute_from_relative(s);
    EXPECT_LT(relative_error(Mr, T.transpose() * Ma * T), limit);
    const VecX expected = T.transpose() * (Qa - Ma * absolute_bias(s));
    EXPECT_LT(relative_error(Qr, expected), limit);
  }
}

TEST(InertiaConsistency, RelativeIsTransformedAbsolute) {
  Random random(2);
  std::vector<Case> cases = isoparametric_bodies();
  const FeModel arm = build_bar_frame(a_arm_frame(5));
  cases.push_back({"hermite", random_basis(arm, 5, MassModel::hermite, 21)});
  cases.push_back({"six_dof", random_basis(arm, 5, MassModel::six_dof, 22)});
  cases.push_back({"six_dof rigid", random_basis(arm, 0, MassModel::six_dof, 23)});
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const int nm = c.body.modes();
    const PreprocessingData data(c.body.invariants);
    PreprocessingWorkspace work(nm);
    check_coordinate_sets(
        nm, random,
        [&](const BodyState& s, MatX& M, VecX& Q) {
          absolute_preprocessing(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, M, Q);
        },
        [&](const BodyState& s, MatX& M, VecX& Q) {
          relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, M, Q);
        },
        tolerance);
    if (!c.body.projection) continue;
    ProjectionWorkspace b_work(*c.body.projection);
    check_coordinate_sets(
        nm, random,
        [&](const BodyState& s, MatX& M, VecX& Q) {
          absolute_projection(*c.body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), b_work, M,
                              Q);
        },
        [&](const BodyState& s, MatX& M, VecX& Q) {
          relative_projection(*c.body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(),
                              b_work, M, Q);
        },
        tolerance);
  }
}

TEST(InertiaConsistency, SixDofAgreesWithExactIntegralsUndeformed) {
  // M at y = 0 is the same; deformed they differ by O(y): theory, section 7.
  const FeModel arm = build_bar_frame(a_arm_frame(5));
  const FlexibleBody six = random_basis(arm, 5, MassModel::six_dof, 31);
  const PreprocessingData data(six.invariants);
  PreprocessingWorkspace work(5);
  ProjectionWorkspace b_work(*six.projection);
  Random random(3);
  BodyState s = random_state(random, 5);
  s.y.setZero();
  MatX M(11, 11), Mb(11, 11), Ma(17, 17), Mba(17, 17);
  VecX Q(11), Qb(11), Qa(17), Qba(17);
  relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, M, Q);
  relative_projection(*six.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), b_work, Mb,
                      Qb);
  EXPECT_LT(relative_error(Mb, M), 1e-13);
  // The absolute M differs where velocities do not belong to a rotation, so it is compared on
  // rotations.
  absolute_preprocessing(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, Ma, Qa);
  absolute_projection(*six.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), b_work, Mba, Qba);
  const MatX T = absolute_from_relative(s);
  EXPECT_LT(relative_error(T.transpose() * Mba * T, T.transpose() * Ma * T), 1e-13);
}

TEST(InertiaConsistency, RigidBodyFormulas) {
  Random random(4);
  const Vec3 c = random.vec3();
  const Mat3 J = Vec3(0.3, 0.4, 0.5).asDiagonal();
  const double m = 2.5;
  const PreprocessingData data(InertiaInvariants::rigid(m, c, J));
  PreprocessingWorkspace work(0);
  MatX M(6, 6);
  VecX Q(6);
  for (int i = 0; i < 10; ++i) {
    const BodyState s = random_state(random, 0);
    relative_preprocessing(data, s.r0, s.A, s.omega, nullptr, nullptr, work, M, Q);
    const Vec3 r = s.r0 + s.A * c;
    const Mat3 J_W = s.A * J * s.A.transpose();
    MatX expected = MatX::Zero(6, 6);
    expected.topLeftCorner<3, 3>() = m * Mat3::Identity();
    expected.block<3, 3>(3, 0) = m * skew(r);
    expected.block<3, 3>(0, 3) = -m * skew(r);
    expected.block<3, 3>(3, 3) = J_W - m * skew(r) * skew(r);
    EXPECT_LT(relative_error(M, expected), 1e-14);
    VecX force(6);
    const Vec3 a = s.omega.cross(s.omega.cross(r));
    force << -m * a, -m * r.cross(a) - s.omega.cross(J_W * s.omega);
    EXPECT_LT(relative_error(Q, force), 1e-13);
  }
}

TEST(InertiaConsistency, QvIsLagrangeForAnyA) {
  // Qv = dT/dq - Mdot qdot along qdot, by central differences, with an A that is not orthonormal.
  const FlexibleBody body =
      random_basis(build_bar_frame(a_arm_frame(5)), 4, MassModel::hermite, 41);
  const int nm = 4, nq = 16;
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(nm);
  Random random(5);
  const BodyState s = random_state(random, nm);
  VecX q(nq), qdot(nq);
  q << s.r0, Eigen::Map<const VecX>(s.A.data(), 9) + random.vector(9, 0.1), s.y;
  qdot << s.sdot, Eigen::Map<const VecX>(s.Adot.data(), 9) + random.vector(9, 0.3), s.ydot;
  VecX scratch(nq);
  const auto mass = [&](const VecX& x, VecX& Qv) {
    MatX M(nq, nq);
    const Mat3 A = Eigen::Map<const Mat3>(x.data() + 3);
    const Mat3 Adot = Eigen::Map<const Mat3>(qdot.data() + 3);
    absolute_preprocessing(data, A, Adot, x.data() + 12, qdot.data() + 12, work, M, Qv);
    return M;
  };
  VecX Qv(nq);
  mass(q, Qv);
  const double h = 1e-5;
  VecX expected(nq);
  for (int i = 0; i < nq; ++i) {
    const VecX step = h * VecX::Unit(nq, i);
    expected(i) =
        0.5 * qdot.dot((mass(q + step, scratch) - mass(q - step, scratch)) * qdot) / (2.0 * h);
  }
  expected -= (mass(q + h * qdot, scratch) - mass(q - h * qdot, scratch)) / (2.0 * h) * qdot;
  EXPECT_LT(relative_error(Qv, expected), 1e-8);
}

TEST(InertiaConsistency, NoHeapInStepTime) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  {
    const AllocationScope scope;
    std::vector<double> probe(10);
    ASSERT_GE(scope.count(), 1u) << "the counter does not work: " << probe.size();
  }
  const FeModel arm = build_bar_frame(a_arm_frame(100));
  for (const MassModel mass_model : {MassModel::isoparametric, MassModel::six_dof}) {
    for (const int nm : {0, 4, 64}) {
      const FlexibleBody body = random_basis(arm, nm, mass_model, 51);
      const PreprocessingData data(body.invariants);
      PreprocessingWorkspace work(nm);
      ProjectionWorkspace b_work(*body.projection);
      Random random(6);
      const BodyState s = random_state(random, nm);
      MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm);
      VecX Qa(12 + nm), Qr(6 + nm);
      const AllocationScope scope;
      relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Mr, Qr);
      absolute_preprocessing(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, Ma, Qa);
      relative_projection(*body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), b_work,
                          Mr, Qr);
      absolute_projection(*body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), b_work, Ma, Qa);
      EXPECT_EQ(scope.count(), 0u);
    }
  }
}

}  // namespace
}  // namespace floatframe::test
