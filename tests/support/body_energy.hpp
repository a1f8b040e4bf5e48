#pragma once
// Kinetic energy of a body whose origin is at rest, to second order in its deformation.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/second_order.hpp"

namespace floatframe::test {

/// w: angular velocity of the frame, body axes. With r = r_u + X y + 1/2 sum e_j y^T h_j y and G =
/// int r r^T dm: 1/2 w^T (tr(G) I - G) w + w . int r x r' dm + 1/2 int r'^2 dm.
inline double energy_of(const InertiaInvariants& v, const SecondOrder& s, const Vec3& w,
                        const VecX& y, const VecX& ydot) {
  Mat3 G = v.P_u, H = Mat3::Zero();  // int r_i r_j, int r_i r'_j
  double rest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const MatX& h = s.S2i[i][j];
      const double first = v.Si[i].row(j).dot(y) + 0.5 * y.dot(h * y);
      G(i, j) += first + y.dot(v.Sij[i][j] * y) / 2.0;
      G(j, i) += first + y.dot(v.Sij[i][j] * y) / 2.0;
      H(i, j) = v.Si[i].row(j).dot(ydot) + y.dot(v.Sij[i][j] * ydot) + y.dot(h * ydot);
    }
    rest += 0.5 * ydot.dot(v.Sij[i][i] * ydot);
  }
  const Vec3 momentum(H(1, 2) - H(2, 1), H(2, 0) - H(0, 2), H(0, 1) - H(1, 0));
  return 0.5 * (G.trace() * w.squaredNorm() - w.dot(G * w)) + w.dot(momentum) + rest;
}

}  // namespace floatframe::test
