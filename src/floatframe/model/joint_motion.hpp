#pragma once
// Relative motion of the two frames of a joint: F on the parent, M on the child, both with z along
// the joint axis and coincident in the design configuration. For coordinates q and velocities v:
//   pose p_FM, R_FM; velocity of M in F: (linear; angular) = H v; acceleration: H vdot + bias, all
//   in axes of F.
// Rotations of spherical and free joints: q holds a unit quaternion (w, x, y, z), v the angular
// velocity of M in F, in axes of F; a step's increment is the rotation vector Theta with R_new =
// exp(skew(Theta)) R.
#include <optional>
#include <string>

#include "floatframe/description/description.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct JointMotion {
  Mat3 R_FM;
  Vec3 p_FM;
  Mat6 H;  ///< the first `joint_velocities(type)` columns are used
  Vec6 bias;
};

/// Of a joint in the joint frame: its axis, and its second axis if it has one.
struct JointDirections {
  Vec3 axis = Vec3::UnitZ();
  Vec3 axis_2 = Vec3::UnitX();
};

enum class JointUnit { m, rad };

/// Number of velocity coordinates of a joint.
int joint_velocities(JointType type) noexcept;

/// Offset of the quaternion in the joint's configuration, -1 if it has none.
int quaternion_offset(JointType type) noexcept;

/// Number of configuration numbers of a joint (quaternions have four).
int joint_configurations(JointType type) noexcept;

/// It constrains nothing: its coordinates are a displacement and a rotation vector.
bool joint_is_free(JointType type) noexcept;

/// Its only coordinate is a displacement along the axis or an angle about it, which a motion can
/// prescribe and a joint spring can act on.
bool joint_has_one_coordinate(JointType type) noexcept;
/// "revolute or prismatic"
std::string joints_of_one_coordinate();

/// "displacement", "angle about `axis_2`", ...
const char* joint_coordinate_name(JointType type, int component) noexcept;
JointUnit joint_unit(JointType type, int component) noexcept;
/// "m", "rad", "m/s" or "rad/s".
const char* joint_unit_name(JointType type, int component, bool rate = false) noexcept;

/// A component of a rotation vector, which no motion can prescribe.
bool is_of_rotation_vector(JointType type, int component) noexcept;
/// The name in model files, as a key: "angle about axis_2".
std::string joint_coordinate_key(JointType type, int component);

/// Of a coordinate that elements may hold in a sum: a displacement along a direction that is fixed
/// in F, or the angle about the z axis that F and M share.
struct CoordinateAxis {
  bool turns = false;
  Vec3 direction = Vec3::UnitZ();  ///< in the joint frame
};
/// None for other coordinates.
std::optional<CoordinateAxis> coordinate_axis(JointType type, const Vec3& axis_2, int component);

/// Pose and H; the bias is set to that at rest.
void joint_motion(JointType type, const JointDirections& axes, const double* q,
                  JointMotion& m) noexcept;

/// The bias at velocities v, where m contains H of the same configuration.
void joint_bias(JointType type, const double* v, JointMotion& m) noexcept;

/// q = q0 moved by the increment x (joint_velocities numbers).
void joint_retract(JointType type, const double* q0, const double* x, double* q) noexcept;

/// x such that joint_retract(q0, x) = joint_retract(joint_retract(q0, x_old), delta): x is updated
/// in place.
void joint_advance(JointType type, double* x, const double* delta) noexcept;

/// Converts start values in the user's form (rotation vectors) to a configuration.
void joint_configuration(JointType type, const double* user, double* q) noexcept;

}  // namespace floatframe
