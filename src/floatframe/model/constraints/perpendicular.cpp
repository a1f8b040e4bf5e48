// Perpendicular: a direction e = R_a e_a of a and a direction n = R_b n_b of b keep the product c
// (0: a right angle).
// The row is scaled by a body length l.
//   phi        l (e.n - c) = 0                                1 row
//   gradient   l e x n on pi_a, -l e x n on pi_b: ds = dpi_a.(e x n) - dpi_b.(e x n)
//   quad       l ((w_a x edot).n + 2 edot.ndot + e.(w_b x ndot)),  edot = w_a x e, ndot = w_b x n
//   curvature  d(e x n) = (e n^T - e.n I) dpi_a + (e.n I - n e^T) dpi_b
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::perpendicular>(const ConstraintPart& part,
                                                       const MarkerState& a, const MarkerState& b,
                                                       double, ConstraintRow* rows) noexcept {
  assert(is_unit(part.e_a) && is_unit(part.n_b) && std::abs(part.c) <= 1.0);
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  const Vec3 torque = part.scale * e.cross(n);
  rows->phi = part.scale * (e.dot(n) - part.c);
  rows->gradient = {Vec3::Zero(), torque, Vec3::Zero(), -torque};
  const Vec3 e_dot = a.w.cross(e);
  const Vec3 n_dot = b.w.cross(n);
  rows->quad =
      part.scale * (a.w.cross(e_dot).dot(n) + 2.0 * e_dot.dot(n_dot) + e.dot(b.w.cross(n_dot)));
  rows->phi_t = rows->phi_tt = 0.0;
}

template <>
void constraint_curvature_of<ConstraintType::perpendicular>(const ConstraintPart& part,
                                                            const MarkerState& a,
                                                            const MarkerState& b,
                                                            const double* lambda,
                                                            Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  const double weight = lambda[0] * part.scale;
  Mat3 by_a = weight * e * n.transpose(), by_b = -weight * n * e.transpose();
  by_a.diagonal().array() -= weight * e.dot(n);
  by_b.diagonal().array() += weight * e.dot(n);
  K.block<3, 3>(pi_a, pi_a) += by_a;
  K.block<3, 3>(pi_a, pi_b) += by_b;
  K.block<3, 3>(pi_b, pi_a) -= by_a;
  K.block<3, 3>(pi_b, pi_b) -= by_b;
}

constinit const ConstraintKind perpendicular_constraint = {.points = false};

}  // namespace floatframe
