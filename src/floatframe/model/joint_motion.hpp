#pragma once
// Relative motion of the two frames of a joint: F on the parent, M on the child, both with z along
// the joint axis and coincident in the design configuration. For coordinates q and velocities v:
//   pose p_FM, R_FM; velocity of M in F: (linear; angular) = H v; acceleration: H vdot + bias, all
//   in axes of F.
// Rotations of spherical and free joints: q holds a unit quaternion (w, x, y, z), v the angular
// velocity of M in F, in axes of F; a step's increment is the rotation vector Theta with R_new =
// exp(skew(Theta)) R.
#include "floatframe/math/so3.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

struct JointMotion {
  Mat3 R_FM;
  Vec3 p_FM;
  Mat6 H;  ///< the first `joint_velocities(type)` columns are used
  Vec6 bias;
};

/// Number of velocity coordinates of a joint.
constexpr int joint_velocities(JointType type) noexcept {
  switch (type) {
    case JointType::weld:
      return 0;
    case JointType::revolute:
    case JointType::prismatic:
      return 1;
    case JointType::cylindrical:
    case JointType::universal:
      return 2;
    case JointType::spherical:
      return 3;
    case JointType::free:
      return 6;
  }
  return 0;
}

/// Number of configuration numbers of a joint (quaternions have four).
constexpr int joint_configurations(JointType type) noexcept {
  return joint_velocities(type) + (type == JointType::spherical || type == JointType::free ? 1 : 0);
}

/// Offset of the quaternion in the joint's configuration, -1 if it has none.
constexpr int quaternion_offset(JointType type) noexcept {
  return type == JointType::spherical ? 0 : type == JointType::free ? 3 : -1;
}

const char* joint_type_name(JointType type) noexcept;

/// `axis_1` (fixed in F) and `axis_2` (fixed in M): axes of a universal joint in the joint frame; z
/// for all others.
void joint_motion(JointType type, const Vec3& axis_1, const Vec3& axis_2, const double* q,
                  const double* v, JointMotion& m) noexcept;

/// q = q0 moved by the increment x (joint_velocities numbers).
void joint_retract(JointType type, const double* q0, const double* x, double* q) noexcept;

/// x such that joint_retract(q0, x) = joint_retract(joint_retract(q0, x_old), delta): x is updated
/// in place.
void joint_advance(JointType type, double* x, const double* delta) noexcept;

/// Start values in the form the user gives them (rotation vectors) to a configuration.
void joint_configuration(JointType type, const double* user, double* q) noexcept;

/// Start values in the user's form (joint_velocities numbers each) of the same joint seen the other
/// way round, parent and child exchanged. Single-axis coordinates change sign, the two axes of a
/// universal joint change places; with R, p the motion of M in F:
///   spherical, free: R' = R^T, p' = -R^T p, w' = -R^T w, pdot' = R^T (w x p - pdot)
void joint_reverse(JointType type, double* position, double* velocity) noexcept;

/// Coordinate numbers for output: rotation vectors instead of quaternions.
double joint_coordinate(JointType type, const double* q, int component) noexcept;

}  // namespace floatframe
