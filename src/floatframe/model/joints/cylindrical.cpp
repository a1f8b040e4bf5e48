// Cylindrical: M slides along z, the common axis of F and M, and rotates about it.
//   coordinates  s: displacement along z [m]; q: angle from x_F to x_M about z [rad]
//   pose         R_FM = R_z(q), p_FM = s z
//   velocity     v_FM = z sdot, w_FM = z qdot: H constant, so the bias is zero
//   parts        r_M on the z axis of F; z_F.x_M = z_F.y_M = 0
//   measured     s = z.p_FM, q = atan2(y_F.x_M, x_F.x_M); sdot = z.v_FM, qdot = z.w_FM
//   mirrored     one axis cannot be polar for s and axial for q: it is polar, and q changes sign
//                with det P, because R(P a, det P q) = P R(a, q) P
//   reversed     p_MF = -s z, R_MF = R_z(-q)
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::cylindrical>(const JointDirections&, const double* q,
                                             JointMotion& m) noexcept {
  m.p_FM.z() = q[0];
  m.R_FM = rotation_about_z(q[1]);
  m.H(2, 0) = 1.0;
  m.H(5, 1) = 1.0;
}

template <>
void joint_bias_of<JointType::cylindrical>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S cylindrical_position(const JointPose<S>& pose, int component) noexcept {
  return component == 0 ? pose.p_FM.z() : pose.angle_about_z();
}

template <class S>
S cylindrical_velocity(const JointTwist<S>& twist, int component) noexcept {
  return component == 0 ? twist.v_FM.z() : twist.w_FM.z();
}

}  // namespace

FLOATFRAME_COORDINATES(cylindrical)

namespace {

void cylindrical_parts(JointParts& parts) {
  parts.add(ConstraintType::in_line);
  parts.parallel_z();
}

void cylindrical_mirror(JointDescription& joint, const Placement& x) {
  joint.axis = x.polar(joint.axis);
  change_sign(joint.position, 1, x.det());
  change_sign(joint.velocity, 1, x.det());
}

void cylindrical_reverse(JointDirections&, double* position, double* velocity) {
  for (int k = 0; k < 2; ++k) {
    position[k] = -position[k];
    velocity[k] = -velocity[k];
  }
}

}  // namespace

constinit const JointKind cylindrical_joint = {
    .about = "slides along `axis` and turns about it",
    .coordinates = {{"displacement", JointUnit::m}, {"angle", JointUnit::rad}},
    .axes = JointAxes::one,
    .parts = cylindrical_parts,
    .mirror = cylindrical_mirror,
    .reverse = cylindrical_reverse};

}  // namespace floatframe
