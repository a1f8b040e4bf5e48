// Joints.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/validate_model.hpp"

namespace floatframe::validation {

namespace {

void start_values(const Entity& joint, const char* key, const std::vector<double>& given,
                  JointType type) {
  const std::size_t n = joint_velocities(type);
  if (given.empty()) return;
  if (n == 0) {
    joint.error(ErrorCode::wrong_value, key, sentences::weld_has_no_coordinates());
  } else if (given.size() != n) {
    joint.error(ErrorCode::wrong_count, key,
                "found a list of " + std::to_string(given.size()) + ", expected " +
                    (n == 1 ? std::string("a number")
                            : "a list of " + std::to_string(n) + " numbers for a " +
                                  joint_type_name(type) + " joint"));
  } else {
    joint.list(key, given);
  }
}

/// Of a joint with several coordinates.
void motions(const JointDescription& j, const Entity& entity) {
  const int n = joint_velocities(j.type);
  std::set<int> taken;
  for (const CoordinateMotion& m : j.motions) {
    const bool there = n > 1 && m.coordinate >= 0 && m.coordinate < n;
    if (!there)
      entity.error(ErrorCode::out_of_range, "motions",
                   sentences::number_of("the number of a coordinate", m.coordinate, n, false));
    else if (is_of_rotation_vector(j.type, m.coordinate))
      entity.error(ErrorCode::unsupported, "motions",
                   sentences::undrivable_coordinate(joint_type_name(j.type)));
    else if (!taken.insert(m.coordinate).second)
      entity.error(ErrorCode::duplicate, "motions",
                   sentences::driven_twice(joint_coordinate_key(j.type, m.coordinate)));
    else
      entity.function("motion." + joint_coordinate_key(j.type, m.coordinate), m.motion);
  }
}

void joint(const JointDescription& j, const Names& names, const Entity& entity) {
  const bool type = entity.word("type", j.type, joint_words);
  if (j.parent.body != ground_name)
    entity.reference("parent", "body", j.parent.body, names.bodies);
  else if (j.parent.node)
    entity.error(ErrorCode::incomplete, "parent_node", sentences::node_on_ground());
  if (j.child.body == ground_name)
    entity.error(ErrorCode::wrong_value, "child", sentences::ground_as_child());
  else if (entity.reference("child", "body", j.child.body, names.bodies) &&
           j.child.body == j.parent.body)
    entity.error(ErrorCode::wrong_value, "child", sentences::child_is_parent());
  if (entity.vector("at", j.parent.point, "m")) entity.vector("at", j.child.point, "m");
  if (!type) return;
  joint_values(j, entity);
  if (j.motion && joint_has_one_coordinate(j.type)) entity.function("motion", *j.motion);
  motions(j, entity);
}

}  // namespace

void joint_values(const JointDescription& j, const Entity& entity) {
  const JointAxes axes = joint_kind(j.type).axes;
  if (axes != JointAxes::none && entity.direction("axis", j.axis) && axes == JointAxes::two &&
      entity.direction("axis_2", j.axis_2))
    entity.complain(ErrorCode::geometry, "axis_2", sentences::second_axis(j.axis, j.axis_2));
  start_values(entity, "position", j.position, j.type);
  start_values(entity, "velocity", j.velocity, j.type);
  if (j.keep && j.position.empty() && j.velocity.empty())
    entity.error(ErrorCode::incomplete, "keep", sentences::keep_without_start_value());
  if (!j.motion) return;
  if (!joint_has_one_coordinate(j.type)) {
    entity.error(ErrorCode::wrong_value, "motion",
                 sentences::not_used_by_joint(joint_type_name(j.type)));
    return;
  }
  if (!j.position.empty())
    entity.error(ErrorCode::exclusive, "position", sentences::motion_and_start_value());
  if (!j.velocity.empty())
    entity.error(ErrorCode::exclusive, "velocity", sentences::motion_and_start_value());
}

void joints(const ModelDescription& d, const Names& names, ErrorList& errors) {
  std::set<std::string> taken;
  for (const JointDescription& j : d.joints) {
    const Entity entity{errors, j.origin, "joints." + j.name};
    name("joints", j.name, taken, entity);
    joint(j, names, entity);
  }
}

}  // namespace floatframe::validation
