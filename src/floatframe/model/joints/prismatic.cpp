// Prismatic: M slides along z, the common axis of F and M, and does not rotate.
//   coordinate   q: displacement along z [m]
//   pose         R_FM = I, p_FM = q z
//   velocity     v_FM = z qdot: H = (z; 0), constant, so the bias is zero
//   parts        r_M on the z axis of F; z_F.x_M = z_F.y_M = x_F.y_M = 0
//   measured     q = z.p_FM, qdot = z.v_FM
//   mirrored     a polar axis: q P a = P (q a)
//   reversed     p_MF = -q z
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::prismatic>(const JointDirections&, const double* q,
                                           JointMotion& m) noexcept {
  m.p_FM.z() = q[0];
  m.H(2, 0) = 1.0;
}

template <>
void joint_bias_of<JointType::prismatic>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S prismatic_position(const JointPose<S>& pose, int) noexcept {
  return pose.p_FM.z();
}

template <class S>
S prismatic_velocity(const JointTwist<S>& twist, int) noexcept {
  return twist.v_FM.z();
}

}  // namespace

FLOATFRAME_COORDINATES(prismatic)

namespace {

void prismatic_parts(JointParts& parts) {
  parts.add(ConstraintType::in_line);
  parts.same_axes();
}

void prismatic_mirror(JointDescription& joint, const Placement& x) {
  joint.axis = x.polar(joint.axis);
}

void prismatic_reverse(JointDirections&, double* position, double* velocity) {
  position[0] = -position[0];
  velocity[0] = -velocity[0];
}

}  // namespace

constinit const JointKind prismatic_joint = {.about = "slides along `axis`",
                                             .coordinates = {{"displacement", JointUnit::m}},
                                             .axes = JointAxes::one,
                                             .parts = prismatic_parts,
                                             .mirror = prismatic_mirror,
                                             .reverse = prismatic_reverse};

}  // namespace floatframe
