// Prescribed angle: x of b is rotated by f(t) from x of a about z, which is kept common to both
// markers by the other parts of the joint. The row is scaled by a body length l.
//   phi        l (atan2(y_a.x_b, x_a.x_b) - f(t)) = 0, within half a turn          1 row
//   gradient, quad and curvature: l times those of the angle (axis_row.hpp)
//   in time    phi_t = -l fdot, phi_tt = -l fddot
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::drive_angle>(const ConstraintPart& part,
                                                     const MarkerState& a, const MarkerState& b,
                                                     double t, ConstraintRow* rows) noexcept {
  assert(part.motion);
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  const Vec3 x = b.R.col(0);
  const double angle = std::atan2(x.dot(a.R.col(1)), x.dot(a.R.col(0)));
  fill_angle_row(part.scale, a, b, *rows);
  rows->phi = part.scale * std::remainder(angle - f.f, 2.0 * std::numbers::pi);
  rows->phi_t = -part.scale * f.df;
  rows->phi_tt = -part.scale * f.ddf;
}

template <>
void constraint_curvature_of<ConstraintType::drive_angle>(const ConstraintPart& part,
                                                          const MarkerState& a, const MarkerState&,
                                                          const double* lambda, Mat12& K) noexcept {
  add_angle_curvature(lambda[0] * part.scale, a, K);
}

constinit const ConstraintKind drive_angle_constraint = {
    .points = false, .angle = true, .on_axis = true, .holds = "prescribed motion"};

}  // namespace floatframe
