#pragma once
// Pose of a frame B in a frame A: x_A = p + R x_B. Names say both frames: X_AB holds p_AB and R_AB.
#include "floatframe/math/types.hpp"

namespace floatframe {

struct Pose {
  Vec3 p = Vec3::Zero();      ///< position of B's origin in A [m]
  Mat3 R = Mat3::Identity();  ///< columns are B's axes in A [-]

  /// X_AC = X_AB * X_BC
  Pose operator*(const Pose& other) const noexcept { return {p + R * other.p, R * other.R}; }
  Vec3 operator*(const Vec3& x_B) const noexcept { return p + R * x_B; }
  Pose inverse() const noexcept { return {-(R.transpose() * p), R.transpose()}; }
};

}  // namespace floatframe
