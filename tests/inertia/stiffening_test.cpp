// Inertia terms with geometric stiffening against point masses whose motion has the second order of
// the modes, against Lagrange's equations of their own mass matrix, and between coordinate sets.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "inertia/lagrange.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe::test {
namespace {

/// Point masses at p with random modes X and random symmetric h.
struct Points {
  int nm;
  std::vector<double> mass;
  std::vector<Vec3> p;
  std::vector<Mat3X> X;
  std::vector<std::array<MatX, 3>> h;

  Points(int modes, unsigned seed) : nm(modes) {
    Random random(seed);
    for (int k = 0; k < 9; ++k) {
      mass.push_back(random(0.5, 2.0));
      p.push_back(random.vec3(1.5));
      X.push_back(random.matrix(3, nm));
      auto& of_point = h.emplace_back();
      for (MatX& m : of_point) {
        const MatX half = random.matrix(nm, nm);
        m = half + half.transpose();
      }
    }
  }
  InertiaInvariants invariants() const {
    InertiaInvariants v = InertiaInvariants::zero(nm);
    for (std::size_t k = 0; k < mass.size(); ++k) {
      v.m += mass[k];
      v.m_u += mass[k] * p[k];
      v.P_u += mass[k] * p[k] * p[k].transpose();
      v.S += mass[k] * X[k];
      for (int i = 0; i < 3; ++i) {
        v.Si[i] += mass[k] * p[k][i] * X[k];
        for (int j = 0; j < 3; ++j) v.Sij[i][j] += mass[k] * X[k].row(i).transpose() * X[k].row(j);
      }
    }
    return v;
  }
  SecondOrder second_order() const {
    SecondOrder s = SecondOrder::zero(nm);
    for (std::size_t k = 0; k < mass.size(); ++k)
      for (int j = 0; j < 3; ++j) {
        s.S2[j] += mass[k] * h[k][j];
        for (int i = 0; i < 3; ++i) s.S2i[i][j] += mass[k] * p[k][i] * h[k][j];
      }
    return s;
  }
  ProjectionData projection() const {
    ProjectionData d;
    const auto n = static_cast<Eigen::Index>(mass.size());
    d.p.resize(3, n);
    d.X.resize(3 * n, nm);
    d.h.resize(3 * n * nm, nm);
    std::vector<Eigen::Triplet<double>> masses;
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      d.p.col(k) = p[at];
      d.X.middleRows(3 * k, 3) = X[at];
      for (int j = 0; j < 3; ++j) d.h.middleRows(nm * (3 * k + j), nm) = h[at][j];
      masses.emplace_back(k, k, mass[at]);
    }
    d.M_s.resize(n, n);
    d.M_s.setFromTriplets(masses.begin(), masses.end());
    return d;
  }
  /// Relative M and Qv of the points themselves; the modes against each other with X alone, or
  /// (`whole`) as they are.
  void relative(const BodyState& s, MatX& M, VecX& Qv, bool whole = false) const {
    M = MatX::Zero(6 + nm, 6 + nm);
    Qv = VecX::Zero(6 + nm);
    for (std::size_t k = 0; k < mass.size(); ++k) {
      Mat3X moved = X[k];
      Vec3 u = X[k] * s.y, own;
      for (int j = 0; j < 3; ++j) {
        moved.row(j) += s.y.transpose() * h[k][j];
        u[j] += 0.5 * s.y.dot(h[k][j] * s.y);
        own[j] = s.ydot.dot(h[k][j] * s.ydot);
      }
      const Vec3 r = s.r0 + s.A * (p[k] + u), rate = s.A * moved * s.ydot;
      MatX B(3, 6 + nm);
      B << Mat3::Identity(), -skew(r), s.A * moved;
      const Vec3 bias = s.omega.cross(s.omega.cross(r) + 2.0 * rate) + s.A * own;
      M += mass[k] * B.transpose() * B;
      Qv -= mass[k] * B.transpose() * bias;
      if (whole) continue;
      // Left out: what S_ij would be with h.
      M.bottomRightCorner(nm, nm) -=
          mass[k] * (moved.transpose() * moved - X[k].transpose() * X[k]);
      Qv.tail(nm) += mass[k] * moved.transpose() * own;
    }
  }
};

struct Stiffened {
  PreprocessingData data;
  StiffeningData stiffening;
  PreprocessingWorkspace work;
  explicit Stiffened(const Points& points)
      : data(points.invariants()), stiffening(data, points.second_order()), work(points.nm) {}
  void relative(const BodyState& s, MatX& M, VecX& Qv) {
    relative_stiffened(data, stiffening, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, M,
                       Qv);
  }
  void absolute(const BodyState& s, MatX& M, VecX& Qv) {
    absolute_stiffened(data, stiffening, s.A, s.Adot, s.y.data(), s.ydot.data(), work, M, Qv);
  }
};

TEST(Stiffening, PointMassesToFirstOrder) {
  // At y = 0 exact, with a fault of second order in y.
  for (const int nm : {1, 4, 7}) {
    SCOPED_TRACE(nm);
    const Points points(nm, 3);
    Stiffened body(points);
    Random random(9);
    const BodyState s = random_state(random, nm);
    MatX M(6 + nm, 6 + nm), Mp;
    VecX Q(6 + nm), Qp;
    const auto faults = [&](double scale, double rate) {
      BodyState x = s;
      x.y = scale * s.y / s.y.norm();
      x.ydot *= rate;
      body.relative(x, M, Q);
      points.relative(x, Mp, Qp);
      return std::pair((M - Mp).norm() / Mp.norm(), (Q - Qp).norm() / Qp.norm());
    };
    const auto [M0, Q0] = faults(0.0, 1.0);
    EXPECT_LT(M0, 1e-14);
    EXPECT_LT(Q0, 1e-13);
    const auto [M1, Q1] = faults(1e-2, 0.0);
    const auto [M2, Q2] = faults(1e-3, 0.0);
    EXPECT_GT(M2, 0.0);
    EXPECT_NEAR(std::log10(M1 / M2), 2.0, 0.1);
    EXPECT_NEAR(std::log10(Q1 / Q2), 2.0, 0.1);
  }
}

TEST(Stiffening, ProjectionIsThePointMasses) {
  for (const int nm : {1, 4, 7}) {
    SCOPED_TRACE(nm);
    const Points points(nm, 6);
    const ProjectionData data = points.projection();
    ProjectionWorkspace work(data, true);
    Random random(2);
    MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm), expected;
    VecX Qa(12 + nm), Qr(6 + nm), Q;
    for (int i = 0; i < 5; ++i) {
      const BodyState s = random_state(random, nm);
      relative_projection(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Mr, Qr);
      points.relative(s, expected, Q, true);
      EXPECT_LT(relative_error(Mr, expected), 1e-13);
      EXPECT_LT(relative_error(Qr, Q), 1e-13);
      absolute_projection(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, Ma, Qa);
      const MatX T = absolute_from_relative(s);
      EXPECT_LT(relative_error(Mr, T.transpose() * Ma * T), 1e-13);
      EXPECT_LT(relative_error(Qr, T.transpose() * (Qa - Ma * absolute_bias(s))), 1e-13);
    }
  }
}

TEST(Stiffening, QvIsLagrangeForAnyA) {
  Stiffened body{Points(4, 4)};
  expect_lagrange(4, 10.0, 1e-9,
                  [&](const BodyState& s, MatX& M, VecX& Qv) { body.absolute(s, M, Qv); });
}

TEST(Stiffening, RelativeIsTransformedAbsolute) {
  for (const int nm : {1, 4, 7}) {
    SCOPED_TRACE(nm);
    Stiffened body{Points(nm, 6)};
    Random random(2);
    MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm);
    VecX Qa(12 + nm), Qr(6 + nm);
    for (int i = 0; i < 5; ++i) {
      const BodyState s = random_state(random, nm);
      body.absolute(s, Ma, Qa);
      body.relative(s, Mr, Qr);
      const MatX T = absolute_from_relative(s);
      EXPECT_LT(relative_error(Mr, T.transpose() * Ma * T), 1e-13);
      EXPECT_LT(relative_error(Qr, T.transpose() * (Qa - Ma * absolute_bias(s))), 1e-13);
    }
  }
}

TEST(Stiffening, WithoutSecondOrderNothingChanges) {
  const int nm = 5;
  const Points points(nm, 8);
  const PreprocessingData data(points.invariants());
  StiffeningData none(data, SecondOrder::zero(nm));
  PreprocessingWorkspace work(nm);
  Random random(3);
  const BodyState s = random_state(random, nm);
  MatX M(6 + nm, 6 + nm), N = M;
  VecX Q(6 + nm), R = Q;
  relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, M, Q);
  relative_stiffened(data, none, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, N, R);
  EXPECT_LT(relative_error(N, M), 1e-15);
  EXPECT_LT(relative_error(R, Q), 1e-14);
}

TEST(Stiffening, CentrifugalStiffnessOfASpinningRod) {
  // Omega about z: h_x = -H of points at x draws with Omega^2 x H, so Qv_f = -Omega^2 H1 y.
  Points points(1, 1);
  double H1 = 0.0;
  for (std::size_t k = 0; k < points.mass.size(); ++k) {
    const double x = 0.1 * static_cast<double>(k + 1);
    points.p[k] = {x, 0.0, 0.0};
    points.X[k] = Vec3(0.0, 0.0, x * x);
    points.h[k].fill(MatX::Zero(1, 1));
    points.h[k][0](0, 0) = -x * x * x;
    H1 += points.mass[k] * x * x * x * x;
  }
  Stiffened body(points);
  BodyState s{Vec3::Zero(), {0.0, 0.0, 3.0},         Vec3::Zero(), Mat3::Identity(),
              Mat3::Zero(), VecX::Constant(1, 0.01), VecX::Zero(1)};
  MatX M(7, 7);
  VecX Q(7);
  body.relative(s, M, Q);
  EXPECT_NEAR(Q[6], -9.0 * H1 * 0.01, 1e-13 * H1);
}

TEST(Stiffening, NoHeapInStepTime) {
  const int nm = 6;
  Stiffened body{Points(nm, 2)};
  Random random(1);
  const BodyState s = random_state(random, nm);
  MatX Ma(12 + nm, 12 + nm), Mr(6 + nm, 6 + nm);
  VecX Qa(12 + nm), Qr(6 + nm);
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  const AllocationScope scope;
  body.relative(s, Mr, Qr);
  body.absolute(s, Ma, Qa);
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace floatframe::test
