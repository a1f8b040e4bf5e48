#pragma once
// What the rows of a point b against a curve of marker a share: p = R_a^T (r_b - r_a), where a is
// the origin of the curve, or slides along it (slide_path.hpp) and is at its foot.
#include <cassert>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/axis_row.hpp"
#include "floatframe/model/space_curve.hpp"

namespace floatframe {

inline CurveFoot foot_of_curve(const SpaceCurve* curve, const MarkerState& a,
                               const MarkerState& b) noexcept {
  assert(a.foot || curve);
  return a.foot ? *a.foot : curve->foot(a.R.transpose() * (b.r - a.r));
}

/// dp/dt in axes of a, against the material point of a.
inline Vec3 rate_against_curve(const MarkerState& a, const MarkerState& b) noexcept {
  return a.R.transpose() * (b.v - a.v - a.w.cross(b.r - a.r));
}

/// K += weight (that along the axis R_a m, and P^T H P), dp = P d(motion).
inline void add_curve_curvature(double weight, const Vec3& m, const Mat3& H, const MarkerState& a,
                                const MarkerState& b, Mat12& K) noexcept {
  using namespace part_of;
  Eigen::Matrix<double, 3, 12> P = Eigen::Matrix<double, 3, 12>::Zero();
  P.middleCols<3>(r_a) = -a.R.transpose();
  P.middleCols<3>(pi_a) = a.R.transpose() * skew(Vec3(b.r - a.r));
  P.middleCols<3>(r_b) = a.R.transpose();
  add_axis_curvature(a.R * m, a, b, weight, K);
  K += weight * P.transpose() * H * P;
}

}  // namespace floatframe
