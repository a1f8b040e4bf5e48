// Joints, and the attachment points on bodies used by them and by forces.
#include <algorithm>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/validate_model.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

std::vector<double> start_values(YamlSection& s, const char* key, JointType type) {
  const auto v = s.get(key);
  if (!v) return {};
  const std::size_t n = joint_velocities(type);
  if (n == 0) return {0.0};  // rejected by `joint_values`
  if (n == 1 && !v->is_list()) return {v->number(any_number("")).value_or(0.0)};
  const std::string what = n == 1 ? "a number"
                                  : "a list of " + std::to_string(n) + " numbers for a " +
                                        joint_type_name(type) + " joint";
  return v->numbers(n, n, any_number(""), what.c_str()).value_or(std::vector<double>(n, 0.0));
}

/// Error at `value` if the body has no node of that name.
bool check_named_node(const ModelInstance& self, const ReadModel& model, const std::string& body,
                      const std::string& node, const YamlValue& value) {
  const auto it = model.bodies.find(body);
  if (it == model.bodies.end()) {
    if (body == ground_name) value.error(ErrorCode::incomplete, sentences::node_on_ground());
    return false;
  }
  if (!it->second.valid) return false;
  if (!it->second.flexible && it->second.named_nodes.empty()) {
    value.error(ErrorCode::incomplete, sentences::node_on_rigid_body(self.written(body)));
    return false;
  }
  if (it->second.named_nodes.count(node)) return true;
  value.not_known(sentences::no_node_named(self.written(body), it->second.flexible, node), node,
                  [&] { return keys_of(it->second.named_nodes); });
  return false;
}

/// A node of a side's body by its name; its design point in coordinates of this file.
std::optional<Vec3> read_node(const ModelInstance& self, const ReadModel& model,
                              const YamlValue& value, AttachmentDescription& side) {
  const auto name = value.text("the name of a node");
  if (!name || !check_named_node(self, model, side.body, *name, value)) return std::nullopt;
  side.node = *name;
  const KnownBody& body = model.bodies.at(side.body);
  return self.local(body.nodes[body.named_nodes.at(*name)]);
}

/// The node given by a key for one side of a joint, likewise.
std::optional<Vec3> joint_node(const ModelInstance& self, const ReadModel& model, YamlSection& s,
                               const char* key, AttachmentDescription& side) {
  const auto v = s.get(key);
  return v ? read_node(self, model, *v, side) : std::nullopt;
}

/// The bodies connected by the joint; empty for one that is unknown.
struct JointBodies {
  std::optional<std::string> parent, child;
};

JointBodies read_sides(const ModelInstance& self, YamlSection& s, JointDescription& j) {
  JointBodies out;
  const auto parent_value = s.get("parent");
  out.parent =
      parent_value ? self.reference(EntityKind::body, *parent_value) : std::string(ground_name);
  const auto child_value = s.require("child");
  if (child_value) out.child = self.reference(EntityKind::body, *child_value);
  if (out.child && *out.child == ground_name)
    child_value->error(ErrorCode::wrong_value, sentences::ground_as_child());
  else if (out.parent && out.child && *out.parent == *out.child)
    child_value->error(ErrorCode::wrong_value, sentences::child_is_parent());
  j.parent.body = out.parent.value_or(ground_name);
  j.child.body = out.child.value_or(ground_name);
  j.parent.origin = j.child.origin = j.origin;
  return out;
}

/// Location of the joint: `at`, its nodes, or the frame origin of the child of a free joint. `type`
/// is null if it is unknown.
void read_place(const ModelInstance& self, const ReadModel& model, YamlSection& s,
                const JointBodies& bodies, std::optional<JointType> type, JointDescription& j) {
  const auto& [parent, child] = bodies;
  const auto of_parent = joint_node(self, model, s, "parent_node", j.parent);
  const auto of_child = joint_node(self, model, s, "child_node", j.child);
  const auto at = s.get("at");
  std::optional<Vec3> point;
  if (at) {
    point = self.read_point(*at);
  } else if (of_parent || of_child) {
    point = of_parent ? of_parent : of_child;
  } else if (!s.has("parent_node") && !s.has("child_node") && type) {
    if (joint_is_free(*type)) {
      if (child) point = frame_origin(self, model, *child);
      if (point && parent) check_node(self, model, *parent, *point, s.value());
    } else {
      s.error(ErrorCode::missing, "missing key 'at'");
    }
  }
  j.parent.point = j.child.point = point.value_or(Vec3::Zero());
  const auto place = at ? at : s.get(of_parent ? "parent_node" : "child_node");
  if (!point || !place) return;
  bool good = true;
  if (parent && !j.parent.node) good = check_node(self, model, *parent, *point, *place);
  if (good && child && !j.child.node) check_node(self, model, *child, *point, *place);
}

void read_axes(YamlSection& s, JointDescription& j) {
  const JointAxes axes = joint_kind(j.type).axes;
  if (axes == JointAxes::none) return;
  const auto axis = s.require("axis");
  const auto a = axis ? read_direction(*axis) : std::nullopt;
  if (a) j.axis = a->stableNormalized();
  if (axes != JointAxes::two) return;
  const auto second = s.require("axis_2");
  const auto b = second ? read_direction(*second) : std::nullopt;
  if (!a || !b) return;
  j.axis_2 = b->stableNormalized();
}

/// {displacement: function, angle: function}, by the names of coordinates.
void read_motions(const ModelInstance& self, const YamlValue& value, JointDescription& j) {
  auto section = value.section("a map of coordinates to functions of time");
  if (!section) return;
  for (int k = 0; k < joint_velocities(j.type); ++k) {
    const auto v = section->get(joint_coordinate_key(j.type, k).c_str());
    if (v && is_of_rotation_vector(j.type, k))
      v->error(ErrorCode::unsupported, sentences::undrivable_coordinate(joint_type_name(j.type)));
    else if (v)
      j.motions.push_back(
          {k, read_motion(self, *v, joint_unit_name(j.type, k), Interpolation::cubic)});
  }
  section->finish();
}

void read_joint(const ModelInstance& self, const std::string& name, YamlSection& s,
                ReadModel& model) {
  JointDescription j;
  j.name = self.prefix + name;
  j.origin = s.origin();
  const auto type_value = s.require("type");
  const auto word = type_value ? type_value->word(joint_words) : std::nullopt;
  const auto type = word ? std::optional(static_cast<JointType>(*word)) : std::nullopt;
  const JointBodies bodies = read_sides(self, s, j);
  read_place(self, model, s, bodies, type, j);
  if (!type) {
    for (const char* key : {"axis", "axis_2", "position", "velocity", "keep", "motion", "cut"})
      s.get(key);
    for (const char* key : joint_element_keys()) s.get(key);
    s.finish();
    return;
  }
  j.type = *type;
  read_axes(s, j);
  const auto unused = [&](const char* key) {
    if (const auto v = s.get(key))
      v->error(ErrorCode::wrong_value, sentences::not_used_by_joint(joint_words[*word]));
  };
  const JointAxes axes = joint_kind(j.type).axes;
  if (axes == JointAxes::none) unused("axis");
  if (axes != JointAxes::two) unused("axis_2");
  if (joint_velocities(j.type) == 0) unused("motion");
  j.position = start_values(s, "position", j.type);
  j.velocity = start_values(s, "velocity", j.type);
  j.keep = s.boolean("keep", false);
  if (const auto v = s.get("motion"); v && joint_velocities(j.type) > 0) {
    if (joint_has_one_coordinate(j.type))
      j.motion = read_motion(self, *v, joint_unit_name(j.type, 0), Interpolation::cubic);
    else
      read_motions(self, *v, j);
  }
  j.cut = s.boolean("cut", false);
  model.joints.emplace(j.name, j.type);
  read_joint_elements(self, name, j.type, s, model);
  s.finish();
  validate_entity(s, j.origin,
                  [&](const validation::Entity& entity) { validation::joint_values(j, entity); });
  place(j, self.world);
  model.description.joints.push_back(std::move(j));
}

}  // namespace

std::optional<Vec3> read_direction(const YamlValue& value) {
  if (value.is_scalar()) {
    const auto w = value.word({"x", "y", "z", "-x", "-y", "-z"});
    if (!w) return std::nullopt;
    return (*w < 3 ? 1.0 : -1.0) * Vec3::Unit(static_cast<Eigen::Index>(*w % 3));
  }
  const auto v = value.vector("");
  const auto complaint = v ? sentences::direction(*v) : std::nullopt;
  value.complain(ErrorCode::out_of_range, complaint);
  return complaint ? std::nullopt : v;
}

std::optional<Vec3> frame_origin(const ModelInstance& self, const ReadModel& model,
                                 const std::string& body) {
  const auto it = model.bodies.find(body);
  if (it == model.bodies.end()) return std::nullopt;
  return self.local(it->second.origin);
}

bool check_node(const ModelInstance& self, const ReadModel& model, const std::string& body,
                const Vec3& point, const YamlValue& value) {
  const auto it = model.bodies.find(body);
  if (it == model.bodies.end() || !it->second.flexible || !it->second.valid) return true;
  const Vec3 p = self.world.point(point);
  const std::vector<Vec3>& nodes = it->second.nodes;
  const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - p).norm() < (b - p).norm(); };
  const auto nearest = std::min_element(nodes.begin(), nodes.end(), nearer);
  if (nearest != nodes.end() && (*nearest - p).norm() <= rules::node_tolerance) return true;
  const Vec3 there = nearest != nodes.end() ? self.local(*nearest) : Vec3::Zero().eval();
  value.error(
      ErrorCode::not_found,
      sentences::no_node_at(point, self.written(body), nearest != nodes.end() ? &there : nullptr));
  return false;
}

std::optional<AttachmentDescription> read_attachment(const ModelInstance& self,
                                                     const ReadModel& model, YamlSection& s,
                                                     AttachedBy by) {
  const bool own = by == AttachedBy::own_keys;
  AttachmentDescription a;
  a.origin = s.origin();
  const auto body_value = s.require("body");
  const auto body = body_value ? self.reference(EntityKind::body, *body_value) : std::nullopt;
  const auto at = s.get("at"), node = s.get("node");
  if (!own) s.finish();
  if (at && node) {
    node->error(ErrorCode::exclusive, "excludes 'at'; remove one of them");
    if (!own) return std::nullopt;
  }
  const auto point = at ? self.read_point(*at) : std::nullopt;
  if (!body || (at && !point)) return std::nullopt;
  a.body = *body;
  if (own && *body == ground_name) {
    body_value->error(ErrorCode::wrong_value, sentences::ground_is_no_body());
    return std::nullopt;
  }
  if (own && !model.bodies.contains(*body)) return std::nullopt;
  const auto place = node    ? read_node(self, model, *node, a)
                     : point ? point
                             : frame_origin(self, model, *body);
  if (!place && !node)
    s.error(ErrorCode::missing, "missing key 'at'");  // the ground has no frame origin
  if (!place || (point && !node && !check_node(self, model, *body, *point, *at)))
    return std::nullopt;
  a.point = *place;
  return a;
}

void read_joints(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, section] : active_entities(self, EntityKind::joint))
    read_joint(self, name, section, model);
}

}  // namespace floatframe
