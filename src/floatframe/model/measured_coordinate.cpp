// Coordinates of joints with any number of them, as elements act on them: checks and ports.
#include <algorithm>
#include <cassert>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

/// "displacement or angle"
std::string coordinates_of(JointType type) {
  std::vector<std::string> keys;
  for (int k = 0; k < joint_velocities(type); ++k)
    if (!is_of_rotation_vector(type, k)) keys.push_back(joint_coordinate_key(type, k));
  std::vector<const char*> words;
  for (const std::string& key : keys) words.push_back(key.c_str());
  return alternatives(words);
}

}  // namespace

void validate_any_coordinate(const ElementCheck& check) {
  if (!check.good("joint") || check.wrong.contains("coordinate")) return;
  const CoordinateTerm of = check.coordinates().front();
  const auto type = check.joint_type(of.joint);
  if (!type) return;
  const int count = joint_velocities(*type), k = std::max(0, of.coordinate);
  const std::string name = joint_type_name(*type), free = coordinates_of(*type);
  if (count == 0)
    check.error(ErrorCode::wrong_value, "joint", sentences::joint_without_coordinates(name));
  else if (of.coordinate >= count)
    check.error(ErrorCode::out_of_range, "coordinate",
                sentences::number_of("the number of a coordinate", of.coordinate, count, false));
  else if (free.empty() || (of.coordinate >= 0 && is_of_rotation_vector(*type, k)))
    check.error(ErrorCode::unsupported, free.empty() ? "joint" : "coordinate",
                sentences::coordinate_of_rotation_vector(name));
  else if (of.coordinate < 0 && count > 1)
    check.error(ErrorCode::incomplete, "",
                "missing key 'coordinate' of a " + name + " joint, expected " + free);
}

std::optional<MeasuredCoordinate> build_any_coordinate(ElementBuild& build) {
  const CoordinateTerm of = build.coordinates().front();
  const int component = std::max(0, of.coordinate);
  const Joint* joint = build.connect_coordinate(of.joint, component);
  if (!joint) return std::nullopt;
  const MeasuredCoordinate measured = measured_coordinate(*joint, component);
  // Turns are counted about an axis that both markers share.
  build.element.coordinates[0].counted = measured.of == MeasuredCoordinate::Of::common_angle;
  return measured;
}

MeasuredCoordinate measured_coordinate(const Joint& joint, int component) {
  using Of = MeasuredCoordinate::Of;
  assert(!is_of_rotation_vector(joint.type, component));
  if (joint_unit(joint.type, component) == JointUnit::rad) {
    if (coordinate_axis(joint.type, joint.axis_2, component)) return {};
    return {component == 0 ? Of::first_angle : Of::second_angle, Vec3::UnitZ(), joint.axis_2};
  }
  JointMotion drawn;
  const double q[7] = {0.0, 0.0, 0.0, 1.0};  // the design, or without a quaternion:
  joint_motion(joint.type, {Vec3::UnitZ(), joint.axis_2}, joint_is_free(joint.type) ? q : q + 4,
               drawn);
  return {Of::displacement, drawn.H.col(component).head<3>(), Vec3::UnitX()};
}

}  // namespace floatframe
