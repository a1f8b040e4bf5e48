// Prescribed angle: x of b is rotated by f(t) from x of a about z, which is kept common to both
// markers by the other parts of the joint. The row is scaled by a body length l.
//   phi        l (atan2(y_a.x_b, x_a.x_b) - f(t)) = 0, within half a turn          1 row
//   gradient   -l z_a on pi_a, l z_a on pi_b
//   quad       l (w_a x z_a).(w_b - w_a)
//   curvature  dz_a = -skew(z_a) dpi_a
//   in time    phi_t = -l fdot, phi_tt = -l fddot
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::drive_angle>(const ConstraintPart& part,
                                                     const MarkerState& a, const MarkerState& b,
                                                     double t, ConstraintRow* rows) noexcept {
  assert(part.motion);
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  const Vec3 x = b.R.col(0);
  const Vec3 z = a.R.col(2);
  const double angle = std::atan2(x.dot(a.R.col(1)), x.dot(a.R.col(0)));
  rows->phi = part.scale * std::remainder(angle - f.f, 2.0 * std::numbers::pi);
  rows->gradient = {Vec3::Zero(), -part.scale * z, Vec3::Zero(), part.scale * z};
  rows->quad = part.scale * a.w.cross(z).dot(b.w - a.w);
  rows->phi_t = -part.scale * f.df;
  rows->phi_tt = -part.scale * f.ddf;
}

template <>
void constraint_curvature_of<ConstraintType::drive_angle>(const ConstraintPart& part,
                                                          const MarkerState& a, const MarkerState&,
                                                          const double* lambda, Mat12& K) noexcept {
  using namespace part_of;
  const Mat3 Z = lambda[0] * part.scale * skew(a.R.col(2));  // dz = -skew(z) dpi_a
  K.block<3, 3>(pi_a, pi_a) += Z;
  K.block<3, 3>(pi_b, pi_a) -= Z;
}

constinit const ConstraintKind drive_angle_constraint = {
    .points = false, .angle = true, .on_axis = true, .holds = "prescribed motion"};

}  // namespace floatframe
