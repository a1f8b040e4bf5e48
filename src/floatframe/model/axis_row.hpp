#pragma once
// Rows of coordinates of joints, with at most a function of time: along an axis n that rotates with
// marker a, of any length,
//   phi  = n.d,  d = r_b - r_a,  phidot = n.(v_b - v_a) + (w_a x n).d
//   quad = (w_a x (w_a x n)).d + 2 (w_a x n).(v_b - v_a)
// and a weight w times the angle about the common z axis,
//   gradient   -w z_a on pi_a, w z_a on pi_b
//   quad       w (w_a x z_a).(w_b - w_a)
//   curvature  dz_a = -skew(z_a) dpi_a
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

inline void fill_axis_row(const Vec3& n, const MarkerState& a, const MarkerState& b,
                          ConstraintRow& row) noexcept {
  const AxisMeasure<double> m = axis_measure(n, a, b);
  row.phi = m.s;
  row.gradient = m.g;
  const Vec3 n_dot = a.w.cross(n);
  row.quad = a.w.cross(n_dot).dot(b.r - a.r) + 2.0 * n_dot.dot(b.v - a.v);
  row.phi_t = row.phi_tt = 0.0;
}

/// All but phi.
inline void fill_angle_row(double weight, const MarkerState& a, const MarkerState& b,
                           ConstraintRow& row) noexcept {
  const Vec3 z = a.R.col(2);
  row.gradient = {Vec3::Zero(), -weight * z, Vec3::Zero(), weight * z};
  row.quad = weight * a.w.cross(z).dot(b.w - a.w);
  row.phi_t = row.phi_tt = 0.0;
}

/// K += weight dg/d(motion).
inline void add_angle_curvature(double weight, const MarkerState& a, Mat12& K) noexcept {
  using namespace part_of;
  const Mat3 Z = weight * skew(a.R.col(2));
  K.block<3, 3>(pi_a, pi_a) += Z;
  K.block<3, 3>(pi_b, pi_a) -= Z;
}

/// phi -= scale f(t), if the part has a function of time.
inline void subtract_motion(const ConstraintPart& part, double t, ConstraintRow& row) noexcept {
  if (!part.motion) return;
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  row.phi -= part.scale * f.f;
  row.phi_t = -part.scale * f.df;
  row.phi_tt = -part.scale * f.ddf;
}

}  // namespace floatframe
