#pragma once
// Distance of marker b from marker a along a direction e that turns with a:
//   s = e.d,  d = r_b - r_a,  sdot = e.(v_b - v_a) + (w_a x e).d
// with the derivatives used by guided springs, joint springs and the constraints along an axis.
// With de = dpi_a x e:
//   gradient      g  = (-e, e x d, e, 0)                     = ds/d(motion) = dsdot/d(rates)
//   of the rate   g' = (-w x e, e x (v + d x w), w x e, 0)   = dsdot/d(motion) at fixed rates,
//                 v = v_b - v_a, w = w_a
//   curvature     dg/d(motion): not symmetric in (dpi_a, dpi_a), because increments of a rotation
//                 multiply from the left
#include "floatframe/math/so3.hpp"
#include "floatframe/model/marker_state.hpp"

namespace floatframe {

struct AxisMeasure {
  double s = 0.0, rate = 0.0;
  WrenchRow g;
};

inline AxisMeasure axis_measure(const Vec3& e, const MarkerState& a,
                                const MarkerState& b) noexcept {
  const Vec3 d = b.r - a.r;
  return {e.dot(d), e.dot(b.v - a.v) + a.w.cross(e).dot(d), {-e, e.cross(d), e, Vec3::Zero()}};
}

inline Vec12 axis_rate_gradient(const Vec3& e, const MarkerState& a,
                                const MarkerState& b) noexcept {
  const Vec3 e_dot = a.w.cross(e);
  return stacked({-e_dot, e.cross(b.v - a.v + (b.r - a.r).cross(a.w)), e_dot, Vec3::Zero()});
}

/// K += weight dg/d(motion).
inline void add_axis_curvature(const Vec3& e, const MarkerState& a, const MarkerState& b,
                               double weight, Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 d = b.r - a.r;
  const Mat3 E = weight * skew(e);
  K.block<3, 3>(r_a, pi_a) += E;
  K.block<3, 3>(r_b, pi_a) -= E;
  K.block<3, 3>(pi_a, r_a) -= E;
  K.block<3, 3>(pi_a, r_b) += E;
  Mat3 turn = e * d.transpose();  // (dpi x e) x d = e (dpi.d) - dpi (e.d)
  turn.diagonal().array() -= e.dot(d);
  K.block<3, 3>(pi_a, pi_a) += weight * turn;
}

}  // namespace floatframe
