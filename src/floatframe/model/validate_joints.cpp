// Joints, rods and inputs.
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model/validate.hpp"

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

void rods(const ModelDescription& d, const Names& names, ErrorList& errors) {
  std::set<std::string> taken;
  for (const RodDescription& r : d.rods) {
    const Entity entity{errors, r.origin, "rods." + r.name};
    name("rods", r.name, taken, entity);
    const bool a = entity.place("from", r.a, names), b = entity.place("to", r.b, names);
    if (r.length) entity.number("length", *r.length, rules::rod_length);
    if (!a || !b) continue;
    if (r.a.body == r.b.body) {
      entity.error(ErrorCode::geometry, sentences::both_ends_on(r.a.body));
    } else if (!r.length && !r.a.node && !r.b.node) {
      if (const auto complaint = sentences::rod_ends(r.a.point, r.b.point))
        entity.error(ErrorCode::geometry, *complaint);
    }
  }
}

namespace {

void initial_value(const InputDescription& i, const Entity& entity) {
  const auto complaint = sentences::input_initial(i.initial, i.low, i.high);
  if (!complaint) return;
  // A key that is missing in a file has no position.
  if (i.origin.keys.empty() || i.origin.keys.contains("initial"))
    entity.error(ErrorCode::out_of_range, "initial", *complaint);
  else
    entity.error(ErrorCode::out_of_range, "initial: " + *complaint);
}

}  // namespace

void input(const InputDescription& i, const Entity& entity) {
  if (const auto complaint = sentences::unit(i.unit))
    entity.error(ErrorCode::wrong_value, "unit", "found '" + i.unit + "', " + *complaint);
  const char* unit = i.unit.c_str();
  bool good = entity.number("initial", i.initial, any_number(unit));
  if (i.low) good = entity.number("min", *i.low, any_number(unit)) && good;
  if (i.high) good = entity.number("max", *i.high, any_number(unit)) && good;
  if (!good) return;
  if (const auto complaint = sentences::clamp_without_limits(i.clamp, i.low, i.high))
    entity.error(ErrorCode::out_of_range, "clamp", *complaint);
  else if (const auto limits = sentences::input_limits(i.low, i.high))
    entity.error(ErrorCode::contradiction, "max", *limits);
  else
    initial_value(i, entity);
}

void inputs(const ModelDescription& d, ErrorList& errors) {
  std::set<std::string> taken;
  for (const InputDescription& i : d.inputs) {
    const Entity entity{errors, i.origin, "inputs." + i.name};
    name("inputs", i.name, taken, entity);
    input(i, entity);
  }
}

}  // namespace floatframe::validation
