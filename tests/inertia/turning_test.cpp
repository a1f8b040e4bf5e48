// Mass that turns with nodes: displacements of second order that are always counted in, by
// preprocessing and projection, against each other, against finite rotations and against Lagrange's
// equations.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "floatframe/inertia/inertia_terms.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "inertia/lagrange.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe::test {
namespace {

/// Nodes with six points each on arms, in pairs about the node, that move with the random
/// displacements and rotations of the node.
struct Discs {
  static constexpr int nodes = 3;
  int nm;
  Mat3X place = Mat3X(3, nodes), arms = Mat3X(3, 6 * nodes);
  VecX mass = VecX(6 * nodes);
  std::vector<Mat3X> U, Theta;
  SecondOrder twist;

  explicit Discs(int modes, bool twisted = true) : nm(modes), twist(SecondOrder::zero(modes)) {
    Random random(11);
    for (int k = 0; k < nodes; ++k) {
      place.col(k) = random.vec3(1.5);
      U.push_back(random.matrix(3, nm));
      Theta.push_back(random.matrix(3, nm));
      for (int i = 0; i < 3; ++i) {
        const int at = 6 * k + 2 * i;
        mass[at] = mass[at + 1] = random(0.5, 2.0);
        arms.col(at) = random.vec3(0.4);
        arms.col(at + 1) = -arms.col(at);
      }
    }
    const auto symmetric = [&] {
      const MatX half = random.matrix(nm, nm, 0.1);
      return MatX(half + half.transpose());
    };
    if (!twisted) return;
    for (MatX& m : twist.S2) m = symmetric();
    for (auto& row : twist.S2i)
      for (MatX& m : row) m = symmetric();
  }

  FlexibleBody body() const {
    const int n = 6 * nodes;
    FlexibleBody b;
    auto d = std::make_shared<ProjectionData>();
    d->p.resize(3, n);
    d->X.resize(3 * n, nm);
    d->rotations.resize(3 * nodes, nm);
    d->twist = std::make_shared<const SecondOrder>(twist);
    SecondOrder turning = twist;
    InertiaInvariants& v = b.invariants;
    v = InertiaInvariants::zero(nm);
    std::vector<Eigen::Triplet<double>> masses;
    for (int k = 0; k < nodes; ++k) {
      const auto at = static_cast<std::size_t>(k);
      d->rotations.middleRows<3>(3 * k) = Theta[at];
      Mat3 P = Mat3::Zero();
      for (int i = 6 * k; i < 6 * k + 6; ++i) {
        const Vec3 arm = arms.col(i), r = place.col(k) + arm;
        const Mat3X X = U[at] - skew(arm) * Theta[at];
        P += mass[i] * arm * arm.transpose();
        d->p.col(i) = r;
        d->X.middleRows<3>(3 * i) = X;
        d->turning.push_back({i, k, arm});
        masses.emplace_back(i, i, mass[i]);
        v.m += mass[i];
        v.m_u += mass[i] * r;
        v.P_u += mass[i] * r * r.transpose();
        v.S += mass[i] * X;
        for (int j = 0; j < 3; ++j) {
          v.Si[j] += mass[i] * r[j] * X;
          for (int l = 0; l < 3; ++l) v.Sij[j][l] += mass[i] * X.row(j).transpose() * X.row(l);
        }
      }
      add_turning(P, Theta[at], turning);
    }
    d->M_s.resize(n, n);
    d->M_s.setFromTriplets(masses.begin(), masses.end());
    b.projection = std::move(d);
    b.turning = std::make_shared<const SecondOrder>(std::move(turning));
    b.K = b.D = MatX::Zero(nm, nm);
    return b;
  }
};

BodyMotion motion_of(const BodyState& s) { return {s.r0, s.A, s.omega, s.y, s.ydot}; }

TEST(Turning, PreprocessingIsProjectionToItsOrder) {
  // M_rf to first order in the amplitudes and M_rr to second order: ten times smaller amplitudes
  // leave a hundredth and a thousandth of the difference.
  for (const int nm : {1, 4, 7}) {
    SCOPED_TRACE(nm);
    const FlexibleBody body = Discs(nm).body();
    Random random(3);
    const BodyState s = random_state(random, nm);
    const auto differences = [&](double size, const auto& one, const auto& other, int rigid) {
      BodyMotion m = motion_of(s);
      m.y *= size / m.y.norm();
      m.ydot.setZero();
      const MatX d = one(body, m).M - other(body, m).M;
      return Vec3(d.topLeftCorner(rigid, rigid).norm(), d.topRightCorner(rigid, nm).norm(),
                  d.bottomRightCorner(nm, nm).norm());
    };
    const auto check = [&](const auto& one, const auto& other, int rigid) {
      const Vec3 a = differences(1e-2, one, other, rigid), b = differences(1e-3, one, other, rigid);
      EXPECT_LT(differences(0.0, one, other, rigid).maxCoeff(), 1e-12);
      EXPECT_NEAR(std::log10(a[0] / b[0]), 3.0, 0.1);
      EXPECT_NEAR(std::log10(a[1] / b[1]), 2.0, 0.1);
      EXPECT_GT(std::log10(a[2] / b[2]), 0.9);  // M_ff is left as it is without amplitudes
    };
    using Terms = InertiaTerms (*)(const FlexibleBody&, const BodyMotion&);
    check(Terms(&relative_preprocessing), Terms(&relative_projection), 6);
    check(Terms(&absolute_preprocessing), Terms(&absolute_projection), 12);
  }
}

TEST(Turning, InertiaIsThatOfTurnedDiscsToSecondOrder) {
  // Discs turned by exp(theta) about their nodes, which move by U y.
  const int nm = 3;
  const Discs discs(nm, false);
  const FlexibleBody body = discs.body();
  Random random(8);
  const VecX y = random.vector(nm);
  const auto difference = [&](double size) {
    BodyMotion m;
    m.y = size * y;
    Mat3 P = Mat3::Zero();
    for (int i = 0; i < 6 * Discs::nodes; ++i) {
      const auto k = static_cast<std::size_t>(i / 6);
      const Vec3 r = discs.place.col(i / 6) + discs.U[k] * m.y +
                     rotation_exp(discs.Theta[k] * m.y) * discs.arms.col(i);
      P += discs.mass[i] * r * r.transpose();
    }
    const Mat3 J = P.trace() * Mat3::Identity() - P;
    return (relative_preprocessing(body, m).M.block<3, 3>(3, 3) - J).norm();
  };
  EXPECT_NEAR(std::log10(difference(1e-2) / difference(1e-3)), 3.0, 0.1);
}

TEST(Turning, MomentaAreThoseOfTurningDiscsToFirstOrder) {
  // M_rf ydot: momentum and angular momentum of discs whose points move as exp(theta) turns them.
  const int nm = 3;
  const Discs discs(nm, false);
  const FlexibleBody body = discs.body();
  Random random(4);
  const VecX y = random.vector(nm), ydot = random.vector(nm);
  const auto difference = [&](double size) {
    BodyMotion m;
    m.y = size * y;
    Vec6 momenta = Vec6::Zero();
    for (int i = 0; i < 6 * Discs::nodes; ++i) {
      const auto k = static_cast<std::size_t>(i / 6);
      const Vec3 theta = discs.Theta[k] * m.y, rate = discs.Theta[k] * ydot;
      const Vec3 arm = rotation_exp(theta) * discs.arms.col(i);
      const Vec3 r = discs.place.col(i / 6) + discs.U[k] * m.y + arm;
      const Vec3 v = discs.U[k] * ydot + Vec3(rotation_tangent(theta) * rate).cross(arm);
      momenta.head<3>() += discs.mass[i] * v;
      momenta.tail<3>() += discs.mass[i] * r.cross(v);
    }
    return (relative_preprocessing(body, m).M.topRightCorner(6, nm) * ydot - momenta).norm();
  };
  EXPECT_NEAR(std::log10(difference(1e-2) / difference(1e-3)), 2.0, 0.1);
}

TEST(Turning, QvIsLagrangeForAnyAxes) {
  const int nm = 4;
  const FlexibleBody body = Discs(nm).body();
  const PreprocessingData data(body.invariants);
  StiffeningData stiffening(data, *body.turning);
  PreprocessingWorkspace work(nm);
  ProjectionWorkspace projection(*body.projection);
  expect_lagrange(nm, 5.0, 1e-8, [&](const BodyState& s, MatX& M, VecX& Qv) {
    absolute_stiffened(data, stiffening, s.A, s.Adot, s.y.data(), s.ydot.data(), work, M, Qv);
  });
  expect_lagrange(nm, 5.0, 1e-8, [&](const BodyState& s, MatX& M, VecX& Qv) {
    absolute_projection(*body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), projection, M,
                        Qv);
  });
}

TEST(Turning, RelativeProjectionIsTransformedAbsolute) {
  const int nm = 4;
  const FlexibleBody body = Discs(nm).body();
  Random random(2);
  for (int i = 0; i < 5; ++i) {
    const BodyState s = random_state(random, nm);
    const InertiaTerms r = relative_projection(body, motion_of(s));
    const InertiaTerms a = absolute_projection(body, motion_of(s));
    const MatX T = absolute_from_relative(s);
    EXPECT_LT(relative_error(r.M, T.transpose() * a.M * T), 1e-13);
    EXPECT_LT(relative_error(r.Qv, T.transpose() * (a.Qv - a.M * absolute_bias(s))), 1e-13);
  }
}

TEST(Turning, AddsToGeometricStiffening) {
  // The sum of both, in either order.
  const int nm = 3;
  FlexibleBody body = Discs(nm).body(), swapped = body;
  body.second_order = std::make_shared<const SecondOrder>(Discs(nm).twist);
  swapped.second_order = body.turning;
  swapped.turning = body.second_order;
  Random random(6);
  BodyMotion m = motion_of(random_state(random, nm));
  m.geometric_stiffening = true;
  const InertiaTerms one = relative_preprocessing(body, m);
  EXPECT_LT(relative_error(one.M, relative_preprocessing(swapped, m).M), 1e-15);
  EXPECT_LT(relative_error(one.Qv, relative_preprocessing(swapped, m).Qv), 1e-14);
  m.geometric_stiffening = false;
  EXPECT_GT(relative_error(one.M, relative_preprocessing(body, m).M), 1e-4);
}

TEST(Turning, NoHeapInStepTime) {
  const int nm = 6;
  const FlexibleBody body = Discs(nm).body();
  ProjectionWorkspace work(*body.projection);
  Random random(1);
  const BodyState s = random_state(random, nm);
  MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm);
  VecX Qa(12 + nm), Qr(6 + nm);
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  const AllocationScope scope;
  relative_projection(*body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Mr,
                      Qr);
  absolute_projection(*body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), work, Ma, Qa);
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace floatframe::test
