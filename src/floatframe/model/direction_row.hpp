#pragma once
// A row of two directions, e of marker a and n of marker b, in world axes, with a weight w:
//   phi        w e.n
//   gradient   w e x n on pi_a, -w e x n on pi_b: ds = dpi_a.(e x n) - dpi_b.(e x n)
//   quad       w ((w_a x edot).n + 2 edot.ndot + e.(w_b x ndot)),  edot = w_a x e, ndot = w_b x n
//   curvature  d(e x n) = (e n^T - e.n I) dpi_a + (e.n I - n e^T) dpi_b
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

inline void clear_row(ConstraintRow& row) noexcept {
  row.phi = row.quad = row.phi_t = row.phi_tt = 0.0;
  row.gradient = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
}
/// Added to the row.
inline void add_direction_row(double weight, const Vec3& e, const Vec3& n, const MarkerState& a,
                              const MarkerState& b, ConstraintRow& row) noexcept {
  const Vec3 torque = weight * e.cross(n);
  const Vec3 e_dot = a.w.cross(e), n_dot = b.w.cross(n);
  row.phi += weight * e.dot(n);
  row.gradient.a.T += torque;
  row.gradient.b.T -= torque;
  row.quad += weight * (a.w.cross(e_dot).dot(n) + 2.0 * e_dot.dot(n_dot) + e.dot(b.w.cross(n_dot)));
}

/// K += weight dg/d(motion).
inline void add_direction_curvature(double weight, const Vec3& e, const Vec3& n,
                                    Mat12& K) noexcept {
  using namespace part_of;
  Mat3 by_a = weight * e * n.transpose(), by_b = -weight * n * e.transpose();
  by_a.diagonal().array() -= weight * e.dot(n);
  by_b.diagonal().array() += weight * e.dot(n);
  K.block<3, 3>(pi_a, pi_a) += by_a;
  K.block<3, 3>(pi_a, pi_b) += by_b;
  K.block<3, 3>(pi_b, pi_a) -= by_a;
  K.block<3, 3>(pi_b, pi_b) -= by_b;
}

}  // namespace floatframe
