// Common functions of all joints, from their number of coordinates, units and rotation vector.
#include "floatframe/model/joint_motion.hpp"

#include <cassert>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

int joint_velocities(JointType type) noexcept { return joint_kind(type).coordinates.count(); }

int quaternion_offset(JointType type) noexcept { return joint_kind(type).rotation_vector; }

int joint_configurations(JointType type) noexcept {
  return joint_velocities(type) + (quaternion_offset(type) >= 0 ? 1 : 0);
}

bool joint_is_free(JointType type) noexcept { return joint_velocities(type) == 6; }

bool joint_has_one_coordinate(JointType type) noexcept { return joint_velocities(type) == 1; }

std::string joints_of_one_coordinate() {
  std::vector<const char*> words;
  for (const JointType type : joint_types)
    if (joint_has_one_coordinate(type)) words.push_back(joint_type_name(type));
  return alternatives(words);
}

const char* joint_coordinate_name(JointType type, int component) noexcept {
  const auto all = joint_kind(type).coordinates.all();
  assert(component >= 0);
  const std::size_t k = component;
  return k < all.size() ? all[k].name : "";
}

JointUnit joint_unit(JointType type, int component) noexcept {
  const auto all = joint_kind(type).coordinates.all();
  assert(component >= 0);
  const std::size_t k = component;
  return k < all.size() ? all[k].unit : JointUnit::rad;
}

bool is_of_rotation_vector(JointType type, int component) noexcept {
  const int first = quaternion_offset(type);
  return first >= 0 && component >= first;
}

std::string joint_coordinate_key(JointType type, int component) {
  std::string key = joint_coordinate_name(type, component);
  std::erase(key, '`');
  return key;
}

const char* joint_unit_name(JointType type, int component, bool rate) noexcept {
  if (joint_unit(type, component) == JointUnit::m) return rate ? "m/s" : "m";
  return rate ? "rad/s" : "rad";
}

std::optional<CoordinateAxis> coordinate_axis(JointType type, const Vec3& axis_2, int component) {
  if (quaternion_offset(type) >= 0) return std::nullopt;
  // H is constant, or else the direction of the coordinate depends on others.
  const double drawn[6] = {}, moved[6] = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  JointMotion m, n;
  joint_motion(type, {Vec3::UnitZ(), axis_2}, drawn, m);
  joint_motion(type, {Vec3::UnitZ(), axis_2}, moved, n);
  if (m.H != n.H) return std::nullopt;
  const Vec3 along = m.H.col(component).head<3>(), about = m.H.col(component).tail<3>();
  if (about.isZero(0.0)) return CoordinateAxis{false, along};
  return CoordinateAxis{true, about};
}

void joint_retract(JointType type, const double* q0, const double* x, double* q) noexcept {
  const JointKind& kind = joint_kind(type);
  const int rotation = kind.rotation_vector;
  const int plain = rotation < 0 ? kind.coordinates.count() : rotation;
  for (int i = 0; i < plain; ++i) q[i] = q0[i] + x[i];
  if (rotation >= 0) {
    assert(is_unit(read_quaternion(q0 + rotation)));
    const Eigen::Quaterniond r =
        quaternion_exp(Vec3(x[rotation], x[rotation + 1], x[rotation + 2])) *
        read_quaternion(q0 + rotation);
    write_quaternion(r.normalized(), q + rotation);
    assert(is_unit(read_quaternion(q + rotation)));
  }
}

void joint_advance(JointType type, double* x, const double* delta) noexcept {
  assert((x != delta && x && delta) || joint_velocities(type) == 0);
  const JointKind& kind = joint_kind(type);
  const int rotation = kind.rotation_vector;
  const int plain = rotation < 0 ? kind.coordinates.count() : rotation;
  for (int i = 0; i < plain; ++i) x[i] += delta[i];
  if (rotation >= 0) {
    Eigen::Map<Vec3> theta(x + rotation);
    const Vec3 step(delta[rotation], delta[rotation + 1], delta[rotation + 2]);
    theta = quaternion_log(quaternion_exp(step) * quaternion_exp(theta));
  }
}

void joint_configuration(JointType type, const double* user, double* q) noexcept {
  assert((user != q && user && q) || joint_velocities(type) == 0);
  assert(all_finite(user, joint_velocities(type)));
  const JointKind& kind = joint_kind(type);
  const int rotation = kind.rotation_vector;
  const int plain = rotation < 0 ? kind.coordinates.count() : rotation;
  for (int i = 0; i < plain; ++i) q[i] = user[i];
  if (rotation >= 0)
    write_quaternion(quaternion_exp(Vec3(user[rotation], user[rotation + 1], user[rotation + 2])),
                     q + rotation);
}

}  // namespace floatframe
