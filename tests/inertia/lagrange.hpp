#pragma once
// Lagrange's equations of a body's own mass matrix.
#include <gtest/gtest.h>

#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {

/// Qv of the absolute coordinates from differences of M, for axes that are not orthonormal.
template <class Terms>
void expect_lagrange(int nm, double size, double tolerance, const Terms& terms) {
  const int nq = 12 + nm;
  Random random(5);
  BodyState s = random_state(random, nm);
  s.y *= size;
  s.A += random.matrix(3, 3, 0.1);
  s.Adot += random.matrix(3, 3, 0.3);
  VecX q(nq), qdot(nq), Qv(nq), scratch(nq);
  q << s.r0, Eigen::Map<const VecX>(s.A.data(), 9), s.y;
  qdot << s.sdot, Eigen::Map<const VecX>(s.Adot.data(), 9), s.ydot;
  const auto mass = [&](const VecX& x, VecX& out) {
    MatX M(nq, nq);
    BodyState at = s;
    at.A = Eigen::Map<const Mat3>(x.data() + 3);
    at.y = x.tail(nm);
    terms(at, M, out);
    return M;
  };
  mass(q, Qv);
  VecX expected(nq);
  const double h = 1e-4;
  for (int i = 0; i < nq; ++i) {
    const VecX step = h * VecX::Unit(nq, i);
    const MatX d = mass(q + step, scratch) - mass(q - step, scratch);
    expected[i] = 0.5 * qdot.dot(d * qdot) / (2.0 * h);
  }
  const MatX rate = mass(q + h * qdot, scratch) - mass(q - h * qdot, scratch);
  expected -= rate * qdot / (2.0 * h);
  EXPECT_LT(relative_error(Qv, expected), tolerance);
}

}  // namespace floatframe::test
