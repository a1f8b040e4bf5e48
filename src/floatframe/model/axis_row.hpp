#pragma once
// A constraint row along an axis n that rotates with marker a, with at most a function of time:
//   phi  = n.d,  d = r_b - r_a,  phidot = n.(v_b - v_a) + (w_a x n).d
//   quad = (w_a x (w_a x n)).d + 2 (w_a x n).(v_b - v_a)
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

}  // namespace floatframe
