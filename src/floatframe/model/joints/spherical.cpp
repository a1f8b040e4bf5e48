// Spherical: a ball joint. M rotates freely about the origin of F; the frames have world axes in
// the design configuration.
//   coordinates  rotation vector theta of M in F [rad]; the configuration holds a unit quaternion
//   pose         R_FM = exp(skew(theta)), p_FM = 0
//   velocity     w_FM, in axes of F: H = (0; I), constant, so the bias is zero
//   parts        r_M = r_F
//   measured     theta = log R_FM, w_FM
//   mirrored     theta and w are axial
//   reversed     R_MF = exp(-skew(theta)), w' = -R_FM^T w
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::spherical>(const JointDirections&, const double* q,
                                           JointMotion& m) noexcept {
  assert(is_unit(read_quaternion(q)));
  m.R_FM = read_quaternion(q).toRotationMatrix();
  m.H.block<3, 3>(3, 0).setIdentity();
}

template <>
void joint_bias_of<JointType::spherical>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S spherical_position(const JointPose<S>& pose, int component) noexcept {
  return pose.rotation_vector()[component];
}

template <class S>
S spherical_velocity(const JointTwist<S>& twist, int component) noexcept {
  return twist.w_FM[component];
}

}  // namespace

FLOATFRAME_COORDINATES(spherical)

namespace {

void spherical_parts(JointParts& parts) { parts.add(ConstraintType::coincident); }

void spherical_mirror(JointDescription& joint, const Placement& x) {
  place_axial(joint.position, 0, x);
  place_axial(joint.velocity, 0, x);
}

void spherical_reverse(JointDirections&, double* position, double* velocity) {
  Eigen::Map<Vec3> theta(position), w_FM(velocity);
  const Mat3 R_MF = rotation_exp(-theta);
  w_FM = (-(R_MF * w_FM)).eval();
  theta = (-theta).eval();
}

}  // namespace

constinit const JointKind spherical_joint = {
    .about = "turns about a point in any way; the rotation vector of the child has world axes",
    .coordinates = {{"rotation vector x", JointUnit::rad},
                    {"rotation vector y", JointUnit::rad},
                    {"rotation vector z", JointUnit::rad}},
    .rotation_vector = 0,
    .oriented = false,
    .parts = spherical_parts,
    .mirror = spherical_mirror,
    .reverse = spherical_reverse};

}  // namespace floatframe
