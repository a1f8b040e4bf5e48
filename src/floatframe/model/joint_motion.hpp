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

struct JointKind {
  JointType type;
  const char* name;
  int velocities;              ///< velocity coordinates
  int quaternion_offset = -1;  ///< of the quaternion in the configuration, -1 if there is none
};

/// All joint types, in the order of JointType. The generic tests run over this list.
inline constexpr JointKind joint_kinds[] = {
    {JointType::weld, "weld", 0},           {JointType::revolute, "revolute", 1},
    {JointType::prismatic, "prismatic", 1}, {JointType::cylindrical, "cylindrical", 2},
    {JointType::universal, "universal", 2}, {JointType::spherical, "spherical", 3, 0},
    {JointType::free, "free", 6, 3}};

constexpr const JointKind& joint_kind(JointType type) noexcept {
  return joint_kinds[static_cast<std::size_t>(type)];
}

static_assert([] {
  std::size_t index = 0;
  for (const JointKind& kind : joint_kinds)
    if (static_cast<std::size_t>(kind.type) != index++) return false;
  return true;
}());

/// Number of velocity coordinates of a joint.
constexpr int joint_velocities(JointType type) noexcept { return joint_kind(type).velocities; }

/// Offset of the quaternion in the joint's configuration, -1 if it has none.
constexpr int quaternion_offset(JointType type) noexcept {
  return joint_kind(type).quaternion_offset;
}

/// Number of configuration numbers of a joint (quaternions have four).
constexpr int joint_configurations(JointType type) noexcept {
  return joint_velocities(type) + (quaternion_offset(type) >= 0 ? 1 : 0);
}

constexpr const char* joint_type_name(JointType type) noexcept { return joint_kind(type).name; }

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
