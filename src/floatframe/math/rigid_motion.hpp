#pragma once
// Rigid motions about the origin, three translations and three rotations, as columns.
#include "floatframe/math/so3.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Rows ux uy uz rx ry rz of a point: u = v + w x p, theta = w.
inline Mat6 rigid_motion_at(const Vec3& p) {
  Mat6 R = Mat6::Identity();
  R.topRightCorner<3, 3>() = -skew(p);
  return R;
}

}  // namespace floatframe
