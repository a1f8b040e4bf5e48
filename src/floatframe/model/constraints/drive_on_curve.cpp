// Prescribed travel along a curve, beside `on_curve`: the parameter u of the foot of b is f(t).
// With p, e and the curve as there, and d = c'.c' - e.c'':
//   phi        u - f(t) = 0                                                     1 row
//   gradient   that along an axis R_a u_p that rotates with a (axis_row.hpp), u_p = c' / d
//   quad       of that axis, and pdot.H pdot, H = du_p/dp
//              H = (c'' u_p^T + u_p c''^T - 3 c'.c'' u_p u_p^T) / d, symmetric
//              if a slides, besides (2 pdot.c*' - 4 c'.c*' udot) / d
//   curvature  of that axis, and P^T H P, dp = P d(motion)
//   in time    phi_t = -fdot, phi_tt = -fddot
// Left out are terms of e. The multiplier is the force along the curve.
#include "floatframe/model/curve_row.hpp"

namespace floatframe {

namespace {

Mat3 drive_hessian(const CurveFoot& f) noexcept {
  const Mat3 part = f.ddc * f.u_p.transpose();
  return (part + part.transpose() - 3.0 * f.dc.dot(f.ddc) * f.u_p * f.u_p.transpose()) / f.slope;
}

}  // namespace

template <>
void constraint_rows_of<ConstraintType::drive_on_curve>(const ConstraintPart& part,
                                                        const MarkerState& a, const MarkerState& b,
                                                        double t, ConstraintRow* rows) noexcept {
  const CurveFoot f = foot_of_curve(part.curve, a, b);
  const Vec3 p_dot = rate_against_curve(a, b);
  fill_axis_row(a.R * f.u_p, a, b, *rows);
  rows->phi = f.u;
  rows->quad += p_dot.dot(drive_hessian(f) * p_dot);
  if (a.foot) rows->quad += (2.0 * p_dot - 4.0 * f.rate(p_dot) * f.dc).dot(f.dc_rate) / f.slope;
  subtract_motion(part, t, *rows);
}

template <>
void constraint_curvature_of<ConstraintType::drive_on_curve>(const ConstraintPart& part,
                                                             const MarkerState& a,
                                                             const MarkerState& b,
                                                             const double* lambda,
                                                             Mat12& K) noexcept {
  const CurveFoot f = foot_of_curve(part.curve, a, b);
  add_curve_curvature(lambda[0], f.u_p, drive_hessian(f), a, b, K);
}

constinit const ConstraintKind drive_on_curve_constraint = {.holds = "prescribed motion"};

}  // namespace floatframe
