// Free: M moves without constraints; the frames have world axes in the design configuration. Bodies
// without a joint that leads to them get one.
//   coordinates  displacement p_FM [m]; rotation vector theta of M in F [rad], in the configuration
//                a unit quaternion
//   pose         R_FM = exp(skew(theta)), p_FM
//   velocity     (pdot; w_FM), in axes of F: H = I, so the bias is zero
//   parts        none
//   measured     p_FM, log R_FM; v_FM, w_FM
//   mirrored     p and pdot are polar, theta and w axial
//   reversed     R' = R^T, p' = -R^T p, w' = -R^T w, pdot' = -R^T (pdot - w x p)
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::free>(const JointDirections&, const double* q,
                                      JointMotion& m) noexcept {
  m.p_FM = Vec3(q[0], q[1], q[2]);
  assert(is_unit(read_quaternion(q + 3)));
  m.R_FM = read_quaternion(q + 3).toRotationMatrix();
  m.H.setIdentity();
}

template <>
void joint_bias_of<JointType::free>(const double*, JointMotion&) noexcept {}

namespace {

template <class S>
S free_position(const JointPose<S>& pose, int component) noexcept {
  return component < 3 ? pose.p_FM[component] : pose.rotation_vector()[component - 3];
}

template <class S>
S free_velocity(const JointTwist<S>& twist, int component) noexcept {
  return component < 3 ? twist.v_FM[component] : twist.w_FM[component - 3];
}

}  // namespace

FLOATFRAME_COORDINATES(free)

namespace {

void free_parts(JointParts&) {}

void free_mirror(JointDescription& joint, const Placement& x) {
  for (std::vector<double>* values : {&joint.position, &joint.velocity}) {
    place_polar(*values, 0, x);
    place_axial(*values, 3, x);
  }
}

void free_reverse(JointDirections&, double* position, double* velocity) {
  Eigen::Map<Vec3> p(position), p_dot(velocity), theta(position + 3), w_FM(velocity + 3);
  const Mat3 R_MF = rotation_exp(-theta);
  p_dot = (-(R_MF * (p_dot - w_FM.cross(p)))).eval();
  p = (-(R_MF * p)).eval();
  w_FM = (-(R_MF * w_FM)).eval();
  theta = (-theta).eval();
}

}  // namespace

constinit const JointKind free_joint = {
    .about =
        "moves in any way, world axes. On a flexible body with a node at `at` (or named by "
        "`child_node`) the displacement is that of the node, the rotation that of the body "
        "frame; without a place it is that of the frame origin",
    .coordinates = {{"displacement x", JointUnit::m},
                    {"displacement y", JointUnit::m},
                    {"displacement z", JointUnit::m},
                    {"rotation vector x", JointUnit::rad},
                    {"rotation vector y", JointUnit::rad},
                    {"rotation vector z", JointUnit::rad}},
    .rotation_vector = 3,
    .oriented = false,
    .parts = free_parts,
    .mirror = free_mirror,
    .reverse = free_reverse};

}  // namespace floatframe
