// Revolute: a hinge. M rotates about z, the common axis of F and M.
//   coordinate   q: angle from x_F to x_M about z [rad]
//   pose         R_FM = R_z(q), p_FM = 0
//   velocity     w_FM = z qdot: H = (0; z), constant, so the bias is zero
//   parts        r_M = r_F; z_F.x_M = z_F.y_M = 0
//   measured     q = atan2(y_F.x_M, x_F.x_M), qdot = z.w_FM
//   mirrored     an axial axis: R(det P a, q) = P R(a, q) P
//   reversed     R_MF = R_z(-q)
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::revolute>(const JointDirections&, const double* q,
                                          JointMotion& m) noexcept {
  m.R_FM = rotation_about_z(q[0]);
  m.H(5, 0) = 1.0;
}

template <>
void joint_bias_of<JointType::revolute>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S revolute_position(const JointPose<S>& pose, int) noexcept {
  return pose.angle_about_z();
}

template <class S>
S revolute_velocity(const JointTwist<S>& twist, int) noexcept {
  return twist.w_FM.z();
}

}  // namespace

FLOATFRAME_COORDINATES(revolute)

namespace {

void revolute_parts(JointParts& parts) {
  parts.add(ConstraintType::coincident);
  parts.parallel_z();
}

void revolute_mirror(JointDescription& joint, const Placement& x) {
  joint.axis = x.axial(joint.axis);
}

void revolute_reverse(JointDirections&, double* position, double* velocity) {
  position[0] = -position[0];
  velocity[0] = -velocity[0];
}

}  // namespace

constinit const JointKind revolute_joint = {.about = "turns about `axis`",
                                            .coordinates = {{"angle", JointUnit::rad}},
                                            .axes = JointAxes::one,
                                            .parts = revolute_parts,
                                            .mirror = revolute_mirror,
                                            .reverse = revolute_reverse};

}  // namespace floatframe
