// Force elements and roads.
#include <cmath>

#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

const std::vector<std::string> force_words{"spring_damper", "guided_spring", "joint_spring",
                                           "tyre",          "force",         "torque"};
constexpr LawUnits spring_units{"m", "N", "N/m"};
constexpr LawUnits damper_units{"m/s", "N", "N s/m"};
constexpr LawUnits torsion_units{"rad", "N m", "N m/rad"};
constexpr LawUnits torsion_damper_units{"rad/s", "N m", "N m s/rad"};

std::optional<AttachmentDescription> end(const ModelInstance& self, const ReadModel& model,
                                         YamlSection& s, const char* key) {
  const auto v = s.require(key);
  if (!v) return std::nullopt;
  const auto section = v->section("a place {body, at}");
  if (!section) return std::nullopt;
  return read_attachment(self, model, *section);
}

/// body and at (or node) written among the keys of the force itself.
std::optional<AttachmentDescription> own_place(const ModelInstance& self, const ReadModel& model,
                                               YamlSection& s) {
  AttachmentDescription a;
  a.origin = s.origin();
  const auto body_value = s.require("body");
  const auto body = body_value ? self.reference(EntityKind::body, *body_value) : std::nullopt;
  const auto at = s.get("at");
  const auto node = s.get("node");
  if (at && node) node->fault("found with 'at', expected one of the two");
  const auto point = at ? self.read_point(*at) : std::nullopt;
  if (!body || (at && !point)) return std::nullopt;
  a.body = *body;
  if (*body == ground_name) {
    body_value->fault(sentences::ground_is_no_body());
    return std::nullopt;
  }
  const auto it = model.bodies.find(*body);
  if (it == model.bodies.end()) return std::nullopt;
  const Placement& w = self.world;
  if (node) {
    const auto name = node->text("the name of a node");
    if (!name || !check_named_node(self, model, *body, *name, *node)) return std::nullopt;
    a.node = *name;
    a.point = w.P * (it->second.nodes[it->second.named_nodes.at(*name)] - w.t);
    return a;
  }
  if (!point) {
    a.point = *frame_origin(self, model, *body);
    return a;
  }
  a.point = *point;
  if (!check_node(self, model, *body, a.point, *at)) return std::nullopt;
  return a;
}

/// spring, damper, bump_stop, rebound_stop, actuator; at least one of them.
void laws(const ModelInstance& self, YamlSection& s, double free, PiecewisePolynomial& spring,
          PiecewisePolynomial& damper, std::optional<SignalDescription>& actuator) {
  int found = 0;
  if (const auto v = s.get("actuator"))
    ++found, actuator = read_signal(self, *v, "N", Interpolation::linear);
  if (const auto v = s.get("spring")) ++found, spring = read_law(*v, free, spring_units);
  if (const auto v = s.get("damper")) ++found, damper = read_law(*v, 0.0, damper_units);
  for (const bool bump : {true, false})
    if (const auto v = s.get(bump ? "bump_stop" : "rebound_stop")) {
      ++found;
      auto stop = v->section("a map with length and stiffness");
      if (!stop) continue;
      const double length = stop->required_number("length", any_number("m"), 0.0);
      const double stiffness = stop->required_number("stiffness", positive_number("N/m"), 1.0);
      stop->finish();
      spring = spring + (bump ? ramp_below(length, stiffness) : ramp_above(length, stiffness));
    }
  if (found == 0) s.fault(sentences::no_law());
}

void spring_damper(const ModelInstance& self, YamlSection& s, ReadModel& model,
                   ForceDescription& f) {
  SpringDamperDescription d;
  const auto a = end(self, model, s, "from"), b = end(self, model, s, "to");
  double length = 0.0;
  if (a && b) {
    d.a = *a;
    d.b = *b;
    length = (a->point - b->point).norm();
    if (a->body == b->body)
      s.fault(sentences::both_ends_on(self.written(a->body)));
    else if (const auto complaint = sentences::spring_ends(a->point, b->point))
      s.fault(*complaint);
  }
  laws(self, s, length, d.spring, d.damper, d.actuator);
  f.kind = std::move(d);
}

void guided_spring(const ModelInstance& self, YamlSection& s, ReadModel& model,
                   ForceDescription& f) {
  GuidedSpringDescription d;
  const auto a = end(self, model, s, "reference"), b = end(self, model, s, "tip");
  const auto axis = s.require("axis");
  if (const auto v = axis ? read_direction(*axis) : std::nullopt) d.axis = v->stableNormalized();
  double length = 0.0;
  if (a && b) {
    d.reference = *a;
    d.tip = *b;
    length = d.axis.dot(a->point - b->point);
    if (a->body == b->body) s.fault(sentences::both_ends_on(self.written(a->body)));
  }
  laws(self, s, length, d.spring, d.damper, d.actuator);
  f.kind = std::move(d);
}

void joint_spring(const ModelInstance& self, YamlSection& s, ReadModel& model,
                  ForceDescription& f) {
  JointSpringDescription d;
  const auto value = s.require("joint");
  const auto joint = value ? self.reference(EntityKind::joint, *value) : std::nullopt;
  bool turning = true;
  if (joint) {
    d.joint = *joint;
    const auto it = model.joints.find(*joint);
    if (it != model.joints.end()) {
      const bool one = joint_has_one_coordinate(it->second);
      turning = one && joint_unit(it->second, 0) == JointUnit::rad;
      if (!one) value->unexpected("a " + joints_of_one_coordinate() + " joint");
    }
  }
  int found = 0;
  if (const auto v = s.get("spring"))
    ++found, d.spring = read_law(*v, 0.0, turning ? torsion_units : spring_units);
  if (const auto v = s.get("damper"))
    ++found, d.damper = read_law(*v, 0.0, turning ? torsion_damper_units : damper_units);
  const bool law = found > 0;
  if (const auto v = s.get("actuator"))
    ++found, d.actuator = read_signal(self, *v, turning ? "N m" : "N", Interpolation::linear);
  if (found == 0) s.fault("found no law, expected spring, damper or actuator");
  const auto target = [&](const char* key, const char* unit, Interpolation table,
                          std::optional<SignalDescription>& out) {
    const auto v = s.get(key);
    if (!v) return;
    out = read_signal(self, *v, unit, table);
    if (!law) v->fault(sentences::target_without_law());
  };
  target("target", turning ? "rad" : "m", Interpolation::cubic, d.target);
  target("target_rate", turning ? "rad/s" : "m/s", Interpolation::linear, d.target_rate);
  f.kind = std::move(d);
}

void tyre(const ModelInstance& self, YamlSection& s, ReadModel& model, ForceDescription& f) {
  TyreDescription d;
  if (const auto a = own_place(self, model, s)) d.centre = *a;
  d.radius = s.required_number("radius", rules::tyre_radius, 1.0);
  d.stiffness = s.required_number("stiffness", rules::tyre_stiffness, 1.0);
  d.damping = s.number("damping", rules::tyre_damping, 0.0);
  if (const auto v = s.get("law"))
    if (const auto w = v->word(rules::tyre_laws)) d.law = static_cast<TyreLaw>(*w);
  if (const auto v = s.get("axis"))
    if (const auto a = read_direction(*v)) d.axis = a->stableNormalized();
  if (const auto v = s.require("road"))
    if (const auto r = self.reference(EntityKind::road, *v)) d.road = *r;
  f.kind = std::move(d);
}

void load(const ModelInstance& self, YamlSection& s, ReadModel& model, ForceDescription& f,
          bool torque) {
  AppliedLoadDescription d;
  d.torque = torque;
  if (const auto a = own_place(self, model, s)) d.at = *a;
  const auto direction = s.require("direction");
  if (const auto v = direction ? read_direction(*direction) : std::nullopt) d.direction = *v;
  if (const auto v = s.require("magnitude"))
    d.magnitude = read_signal(self, *v, torque ? "N m" : "N", Interpolation::linear);
  d.follows = s.boolean("follows", false);
  f.kind = std::move(d);
}

/// Points [x, z] of a road; two with the same x are a step.
PiecewisePolynomial read_profile(const YamlValue& value) {
  const TableRows table = read_table_rows(value, any_number("m"), "a point [x, z] [m]");
  if (table.good && table.rows.empty())
    value.fault(value.is_list() ? "found an empty list, expected points [x, z]"
                                : "found no rows in '" + table.file + "', expected points x, z");
  std::vector<TablePoint> points;
  for (const TableRow& row : table.rows) {
    const double x = row.point.x;
    const std::size_t n = points.size();
    if (n > 0 && x < points.back().x)
      table.fault(row, "found x = " + number_text(x) + " after " + number_text(points.back().x) +
                           ", expected x that does not decrease [m]");
    else if (n > 1 && x == points[n - 1].x && x == points[n - 2].x)
      table.fault(row,
                  "found x = " + number_text(x) + " a third time, expected two points at a jump");
    else
      points.push_back(row.point);
  }
  return points.empty() ? PiecewisePolynomial() : profile_function(points);
}

}  // namespace

void read_forces(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::force)) {
    ForceDescription f;
    f.name = self.prefix + name;
    f.origin = s.origin();
    const auto value = s.require("type");
    const auto type = value ? value->word(force_words) : std::nullopt;
    if (!type) continue;
    switch (*type) {
      case 0:
        spring_damper(self, s, model, f);
        break;
      case 1:
        guided_spring(self, s, model, f);
        break;
      case 2:
        joint_spring(self, s, model, f);
        break;
      case 3:
        tyre(self, s, model, f);
        break;
      default:
        load(self, s, model, f, *type == 5);
    }
    s.finish();
    model.force_types.emplace(f.name, force_words[*type]);
    place(f, self.world);
    model.description.forces.push_back(std::move(f));
  }
}

void read_roads(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::road)) {
    RoadDescription r;
    r.name = self.prefix + name;
    r.origin = s.origin();
    if (const auto v = s.get("profile")) r.pieces = read_profile(*v);
    if (const auto v = s.get("bumps"))
      for (const YamlValue& item : v->list("a list of bumps {start, length, height}")) {
        auto b = item.section("a bump {start, length, height}");
        if (!b) continue;
        CosineBump bump;
        bump.start = b->required_number("start", any_number("m"), 0.0);
        bump.length = b->required_number("length", rules::bump_length, 1.0);
        bump.height = b->required_number("height", any_number("m"), 0.0);
        b->finish();
        r.bumps.push_back(bump);
      }
    s.finish();
    model.description.roads.push_back(std::move(r));
  }
}

}  // namespace floatframe
