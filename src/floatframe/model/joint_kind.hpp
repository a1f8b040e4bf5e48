#pragma once
// Interface of a joint. A new joint is one file model/joints/<name>.cpp and one entry in
// joint_list.hpp: reader, validation, mirror, outputs, both formulations, the table of the
// documentation and the generic tests run over the list.
//
// A joint connects frame F on the parent and frame M on the child. Both have z along `axis` (world
// axes where the joint has none) and coincide in the design configuration. Step time calls the
// functions below by name, without a pointer; the pointers of a JointKind serve load time.
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <span>

#include "floatframe/description/placement.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

// ----------------------------------------------------------------------------------------------
// step time: noexcept, no allocation

/// Fills p_FM, R_FM and the columns of H, which are zero motion on entry.
template <JointType type>
void joint_motion_of(const JointDirections& axes, const double* q, JointMotion& m) noexcept;

/// Fills bias = Hdot v, which is zero on entry. `m` contains p_FM, R_FM and H of the same
/// configuration. Empty if H is constant.
template <JointType type>
void joint_bias_of(const double* v, JointMotion& m) noexcept;

/// M seen from F, in axes of F, over double or Dual (math/dual.hpp).
template <class S>
struct JointPose {
  const Vec3& axis_2;  ///< of the joint, in the joint frame
  Eigen::Matrix<S, 3, 3> R_FM;
  Eigen::Matrix<S, 3, 1> p_FM;
  double reference;  ///< angles are returned within half a turn of it

  S near_reference(const S& angle) const noexcept { return near_angle(angle, reference); }
  /// From x_F to x_M about z.
  S angle_about_z() const noexcept {
    using std::atan2;
    return near_reference(atan2(R_FM(1, 0), R_FM(0, 0)));
  }
  Eigen::Matrix<S, 3, 1> rotation_vector() const noexcept {
    return quaternion_log(Eigen::Quaternion<S>(R_FM));
  }
};

template <class S>
struct JointTwist {
  const Vec3& axis_2;
  Eigen::Matrix<S, 3, 3> R_FM;
  /// Velocity of the origin of M and angular velocity of M in F, axes of F.
  Eigen::Matrix<S, 3, 1> v_FM, w_FM;
};

/// Coordinate `component` in the form of the user (rotation vectors), and its rate as in H v.
template <JointType type, class S>
S joint_position_of(const JointPose<S>& pose, int component) noexcept;
template <JointType type, class S>
S joint_velocity_of(const JointTwist<S>& twist, int component) noexcept;

/// Both of a joint, by the templates <name>_position and <name>_velocity over their scalar.
#define FLOATFRAME_COORDINATES(name)                                                           \
  template <>                                                                                  \
  double joint_position_of<JointType::name>(const JointPose<double>& pose, int k) noexcept {   \
    return name##_position(pose, k);                                                           \
  }                                                                                            \
  template <>                                                                                  \
  Dual joint_position_of<JointType::name>(const JointPose<Dual>& pose, int k) noexcept {       \
    return name##_position(pose, k);                                                           \
  }                                                                                            \
  template <>                                                                                  \
  double joint_velocity_of<JointType::name>(const JointTwist<double>& twist, int k) noexcept { \
    return name##_velocity(twist, k);                                                          \
  }                                                                                            \
  template <>                                                                                  \
  Dual joint_velocity_of<JointType::name>(const JointTwist<Dual>& twist, int k) noexcept {     \
    return name##_velocity(twist, k);                                                          \
  }

inline Mat3 rotation_about_z(double angle) noexcept {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 r;
  r << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return r;
}

/// Quaternions (w, x, y, z) of a configuration.
inline Eigen::Quaterniond read_quaternion(const double* q) noexcept {
  return {q[0], q[1], q[2], q[3]};
}

inline void write_quaternion(const Eigen::Quaterniond& r, double* q) noexcept {
  assert(is_unit(r));
  q[0] = r.w();
  q[1] = r.x();
  q[2] = r.y();
  q[3] = r.z();
}

// ----------------------------------------------------------------------------------------------
// load time

/// A velocity coordinate of a joint, in the order of start values.
struct JointCoordinate {
  const char* name;
  JointUnit unit;
};

class JointCoordinates {
 public:
  constexpr JointCoordinates(std::initializer_list<JointCoordinate> list) {
    assert(list.size() <= std::size(items_));
    for (const JointCoordinate& c : list) items_[count_++] = c;
  }
  constexpr int count() const noexcept { return static_cast<int>(count_); }
  constexpr std::span<const JointCoordinate> all() const noexcept { return {items_, count_}; }

 private:
  JointCoordinate items_[6] = {};
  std::size_t count_ = 0;
};

/// What model files must give: nothing, `axis`, or `axis` and an `axis_2` not parallel to it.
enum class JointAxes { none, one, two };

/// Collects the constraint parts that fix M to F; a direction row is scaled by a body length.
class JointParts {
 public:
  JointParts(const Joint& joint, int index, double length, std::vector<ConstraintPart>& parts);
  /// In the joint frame.
  const Vec3& axis_2() const noexcept { return axis_2_; }
  /// Scales rows of directions to metres [m].
  double length() const noexcept { return length_; }
  /// A part with a = F and b = M (reactions are assigned by them), to be completed if its kind has
  /// more than the two markers.
  ConstraintPart& add(ConstraintType type);
  /// The direction e_F, fixed in F, keeps the product c with n_M, fixed in M.
  void perpendicular(const Vec3& e_F, const Vec3& n_M, double c = 0.0);
  /// The z axes stay parallel.
  void parallel_z() {
    perpendicular(Vec3::UnitZ(), Vec3::UnitX());
    perpendicular(Vec3::UnitZ(), Vec3::UnitY());
  }
  /// All axes stay parallel.
  void same_axes() {
    parallel_z();
    perpendicular(Vec3::UnitX(), Vec3::UnitY());
  }

 private:
  const Vec3& axis_2_;
  ConstraintPart base_;
  double length_;
  std::vector<ConstraintPart>& parts_;
};

struct JointKind {
  const char* about;  ///< the allowed motion: for the documentation, a phrase in Markdown
  /// In the order of the motion from F to M: a coordinate moves only directions of later ones,
  /// otherwise the tangent of the tree is not exact. Seen from the child (`reverse`) it must be a
  /// joint of the same kind.
  JointCoordinates coordinates;
  /// First of three coordinates that form a rotation vector: the configuration contains a
  /// quaternion instead, their velocities are the angular velocity w_FM. -1 without one.
  int rotation_vector = -1;
  JointAxes axes = JointAxes::none;
  /// F and M rotate with their nodes. A joint that is not oriented uses only points: its rotation
  /// is that of the body frames.
  bool oriented = true;
  /// The same joint as constraints: 6 - coordinates rows.
  void (*parts)(JointParts& parts);
  /// The mirrored joint: axes and start values of the description (not its places).
  void (*mirror)(JointDescription& joint, const Placement& x);
  /// The joint seen from the child: R_MF, p_MF in its coordinates and rates, in the user's form,
  /// and its axes then.
  void (*reverse)(JointDirections& axes, double* position, double* velocity);
};

const JointKind& joint_kind(JointType type) noexcept;

/// The sign of a coordinate of the mirrored joint.
double mirrored_sign(JointType type, int component, const Placement& x);

/// Orientation of F and M in the design configuration.
Mat3 joint_frame(const JointDescription& joint);

#define FLOATFRAME_KIND(name) extern const JointKind name##_joint;
FLOATFRAME_JOINTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

}  // namespace floatframe
