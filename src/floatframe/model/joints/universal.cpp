// Universal: M rotates about e1, fixed in F, and about e2, fixed in M. In the design configuration
// both are given in the joint frame, with z = e1; they need not be perpendicular.
//   coordinates  q1: angle about e1, q2: angle about e2 [rad]
//   pose         R_FM = exp(q1 e1) exp(q2 e2), p_FM = 0
//   velocity     w_FM = e1 q1dot + e2' q2dot with e2' = exp(q1 e1) e2 = R_FM e2
//   bias         e2' rotates about e1: q1dot q2dot e1 x e2'
//   parts        r_M = r_F; e1.e2' keeps its value
//   measured     q1 rotates e2 about e1 onto e2'; q2 is the rest, about e2. With c = e1.e2',
//                a = e1.w_FM = q1dot + c q2dot, b = e2'.w_FM = c q1dot + q2dot:
//                q1dot = (a - c b)/(1 - c^2), q2dot = (b - c a)/(1 - c^2). c = e1.e2 at any q1, so
//                it never reaches 1: parallel axes are refused in the design configuration
//   mirrored     both axes are axial
//   reversed     R_MF = exp(-q2 e2) exp(-q1 e1): the axes change places, the angles too, and sign
#include <cassert>
#include <utility>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

template <>
void joint_motion_of<JointType::universal>(const JointDirections& axes, const double* q,
                                           JointMotion& m) noexcept {
  assert(is_unit(axes.axis) && is_unit(axes.axis_2));
  const Mat3 r1 = rotation_exp(q[0] * axes.axis);
  m.R_FM = r1 * rotation_exp(q[1] * axes.axis_2);
  const Vec3 e2 = r1 * axes.axis_2;
  m.H.block<3, 1>(3, 0) = axes.axis;
  m.H.block<3, 1>(3, 1) = e2;
}

template <>
void joint_bias_of<JointType::universal>(const double* v, JointMotion& m) noexcept {
  const Vec3 e1 = m.H.block<3, 1>(3, 0), e2 = m.H.block<3, 1>(3, 1);
  m.bias.tail<3>() = v[0] * v[1] * e1.cross(e2);
}

namespace {

template <class S>
S universal_position(const JointPose<S>& pose, int component) noexcept {
  using std::atan2, std::cos, std::sin;
  using V = Eigen::Matrix<S, 3, 1>;
  const Vec3& e2 = pose.axis_2;
  const V turned = pose.R_FM * V(e2.template cast<S>());
  const S q1 = atan2(S(e2.x() * turned.y() - e2.y() * turned.x()),
                     S(e2.x() * turned.x() + e2.y() * turned.y()));
  if (component == 0) return pose.near_reference(q1);
  Vec3 t1, t2;
  orthonormal_complement(e2, t1, t2);
  V s = pose.R_FM * V(t1.template cast<S>());  // turned back by q1 about z
  const S c = cos(q1), n = sin(q1);
  s = V(c * s.x() + n * s.y(), c * s.y() - n * s.x(), s.z());
  const auto part = [&s](const Vec3& t) {
    return S(t.x() * s.x() + t.y() * s.y() + t.z() * s.z());
  };
  return pose.near_reference(atan2(part(t2), part(t1)));
}

template <class S>
S universal_velocity(const JointTwist<S>& twist, int component) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const V e2 = twist.R_FM * V(twist.axis_2.template cast<S>());
  const S c = e2.z(), a = twist.w_FM.z(), b = e2.dot(twist.w_FM);
  const S det = 1.0 - c * c;
  assert(!(det <= 0.0));  // axes that are not parallel
  return component == 0 ? (a - c * b) / det : (b - c * a) / det;
}

}  // namespace

FLOATFRAME_COORDINATES(universal)

namespace {

void universal_parts(JointParts& parts) {
  parts.add(ConstraintType::coincident);
  parts.perpendicular(Vec3::UnitZ(), parts.axis_2(), parts.axis_2().z());
}

void universal_mirror(JointDescription& joint, const Placement& x) {
  joint.axis = x.axial(joint.axis);
  joint.axis_2 = x.axial(joint.axis_2);
}

void universal_reverse(JointDirections& axes, double* position, double* velocity) {
  std::swap(axes.axis, axes.axis_2);
  for (double* value : {position, velocity}) {
    std::swap(value[0], value[1]);
    value[0] = -value[0];
    value[1] = -value[1];
  }
}

}  // namespace

constinit const JointKind universal_joint = {
    .about = "turns about `axis`, fixed in the parent, and about `axis_2`, fixed in the child",
    .coordinates = {{"angle about `axis`", JointUnit::rad},
                    {"angle about `axis_2`", JointUnit::rad}},
    .axes = JointAxes::two,
    .parts = universal_parts,
    .mirror = universal_mirror,
    .reverse = universal_reverse};

}  // namespace floatframe
