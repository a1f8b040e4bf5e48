#pragma once
// The coordinates of joints as elements and constraints measure them: the distance of marker b from
// marker a along a direction e that turns with a, and the angle about z_a.
// Along e:
//   s = e.d,  d = r_b - r_a,  sdot = e.(v_b - v_a) + (w_a x e).d
// With de = dpi_a x e:
//   gradient      g  = (-e, e x d, e, 0)                     = ds/d(motion) = dsdot/d(rates)
//   curvature     dg/d(motion): not symmetric in (dpi_a, dpi_a), because increments of a rotation
//                 multiply from the left
#include <cmath>
#include <numbers>

#include "floatframe/math/dual.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/marker_state.hpp"

namespace floatframe {

template <class S>
struct AxisMeasure {
  S s = 0.0, rate = 0.0;
  WrenchPair<S> g;
};

template <class S, class Marker>
AxisMeasure<S> axis_measure(const Eigen::Matrix<S, 3, 1>& e, const Marker& a,
                            const Marker& b) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const V d = b.r - a.r;
  return {e.dot(d), e.dot(b.v - a.v) + a.w.cross(e).dot(d), {{-e, e.cross(d)}, {e, V::Zero()}}};
}

/// The angle within half a turn of `reference`.
template <class S>
S near_angle(const S& angle, double reference) noexcept {
  const double near = std::remainder(value_of(angle) - reference, 2.0 * std::numbers::pi);
  return chained(reference + near, 1.0, angle);
}

/// The angle of x_b from x_a about z_a, within half a turn of `reference`. Its gradient is (0, -z,
/// 0, z) where the markers share the z axis.
template <class S, class Marker>
S angle_about_z(const Marker& a, const Marker& b, double reference) noexcept {
  using std::atan2;
  const Eigen::Matrix<S, 3, 1> x = b.R.col(0);
  return near_angle(atan2(S(x.dot(a.R.col(1))), S(x.dot(a.R.col(0)))), reference);
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
