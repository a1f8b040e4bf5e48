// Dispatch of the joints: data for load time, direct calls for step time.
#include <cassert>
#include <iterator>
#include <utility>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KIND(name) &name##_joint,
constexpr const JointKind* joint_list[] = {FLOATFRAME_JOINTS(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

/// Calls f with the type as a constant: comparisons and direct calls, no pointer.
template <class F, std::size_t... I>
void with_type(JointType type, std::index_sequence<I...>, F f) noexcept {
  static_cast<void>(((type == static_cast<JointType>(I) &&
                      (f(std::integral_constant<JointType, static_cast<JointType>(I)>{}), true)) ||
                     ...));
}

constexpr std::make_index_sequence<std::size(joint_list)> all_types;

template <class S, class Marker>
S position_at(const Joint& joint, const Marker& F, const Marker& M, int component,
              double reference) noexcept {
  assert(component >= 0 && component < joint_velocities(joint.type));
  assert(is_unit(joint.axis_2));
  const JointPose<S> pose{joint.axis_2, F.R.transpose() * M.R, F.R.transpose() * (M.r - F.r),
                          reference};
  S q = 0.0;
  with_type(joint.type, all_types, [&](auto t) { q = joint_position_of<t()>(pose, component); });
  return q;
}

template <class S, class Marker>
S velocity_at(const Joint& joint, const Marker& F, const Marker& M, int component) noexcept {
  assert(component >= 0 && component < joint_velocities(joint.type));
  const Eigen::Matrix<S, 3, 1> d = M.r - F.r;
  const JointTwist<S> twist{joint.axis_2, F.R.transpose() * M.R,
                            F.R.transpose() * (M.v - F.v - F.w.cross(d)),
                            F.R.transpose() * (M.w - F.w)};
  S v = 0.0;
  with_type(joint.type, all_types, [&](auto t) { v = joint_velocity_of<t()>(twist, component); });
  return v;
}

}  // namespace

const JointKind& joint_kind(JointType type) noexcept {
  assert(index_of(type) < std::size(joint_list));
  return *joint_list[index_of(type)];
}

double mirrored_sign(JointType type, int component, const Placement& x) {
  JointDescription joint;
  joint.type = type;
  joint.position.assign(joint_velocities(type), 1.0);
  joint_kind(type).mirror(joint, x);
  return static_cast<std::size_t>(component) < joint.position.size() ? joint.position[component]
                                                                     : 1.0;
}

void joint_motion(JointType type, const JointDirections& axes, const double* q,
                  JointMotion& m) noexcept {
  assert((q || joint_configurations(type) == 0) && is_unit(axes.axis));
  m.R_FM.setIdentity();
  m.p_FM.setZero();
  m.H.setZero();
  m.bias.setZero();
  with_type(type, all_types, [&](auto t) { joint_motion_of<t()>(axes, q, m); });
  assert(is_rotation(m.R_FM));
}

void joint_bias(JointType type, const double* v, JointMotion& m) noexcept {
  assert(v || joint_velocities(type) == 0);
  with_type(type, all_types, [&](auto t) { joint_bias_of<t()>(v, m); });
}

double joint_position(const Joint& joint, const MarkerState& F, const MarkerState& M, int component,
                      double reference) noexcept {
  return position_at<double>(joint, F, M, component, reference);
}
Dual joint_position(const Joint& joint, const MarkerMotion<Dual>& F, const MarkerMotion<Dual>& M,
                    int component, double reference) noexcept {
  return position_at<Dual>(joint, F, M, component, reference);
}
double joint_velocity(const Joint& joint, const MarkerState& F, const MarkerState& M,
                      int component) noexcept {
  return velocity_at<double>(joint, F, M, component);
}
Dual joint_velocity(const Joint& joint, const MarkerMotion<Dual>& F, const MarkerMotion<Dual>& M,
                    int component) noexcept {
  return velocity_at<Dual>(joint, F, M, component);
}

}  // namespace floatframe
