// Bodies: position and orientation, rigid data, the choice between rigid and flexible.
#include <cmath>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/surface_points.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {

Mat3 read_orientation(const YamlValue& value, double* largest_angle) {
  const auto note = [&](std::initializer_list<double> angles) {
    if (largest_angle == nullptr) return;
    for (const double x : angles)
      if (std::abs(x) > std::abs(*largest_angle)) *largest_angle = x;
  };
  const char* what =
      "a rotation vector [rx, ry, rz] [rad], a quaternion [w, x, y, z] or {roll, pitch, yaw} [rad]";
  if (value.is_map()) {
    auto s = value.section();
    const double roll = s->number("roll", any_number("rad"), 0.0);
    const double pitch = s->number("pitch", any_number("rad"), 0.0);
    const double yaw = s->number("yaw", any_number("rad"), 0.0);
    s->finish();
    note({roll, pitch, yaw});
    return rotation_exp(yaw * Vec3::UnitZ()) * rotation_exp(pitch * Vec3::UnitY()) *
           rotation_exp(roll * Vec3::UnitX());
  }
  const auto v = value.numbers(3, 4, any_number(""), what);
  if (!v) return Mat3::Identity();
  if (v->size() == 3) {
    note({(*v)[0], (*v)[1], (*v)[2]});
    return rotation_exp(Vec3((*v)[0], (*v)[1], (*v)[2]));
  }
  const Eigen::Quaterniond q((*v)[0], (*v)[1], (*v)[2], (*v)[3]);
  if (std::abs(q.norm() - 1.0) > 1e-6) {
    value.error(ErrorCode::wrong_value, "found a quaternion of length " +
                                            number_text(std::round(q.norm() * 1e6) / 1e6) +
                                            ", expected length 1");
    return Mat3::Identity();
  }
  return q.normalized().toRotationMatrix();
}

namespace {

Mat3 read_inertia(const YamlValue& value) {
  const char* what = "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] [kg m2]";
  if (value.is_list() && value.node().items.size() != 3 && value.node().items.size() != 6) {
    value.unexpected(what);
    return Mat3::Zero();
  }
  const auto v = value.numbers(3, 6, any_number("kg m2"), what);
  if (!v) return Mat3::Zero();
  Mat3 J = Vec3((*v)[0], (*v)[1], (*v)[2]).asDiagonal();
  if (v->size() == 6) {
    J(0, 1) = J(1, 0) = (*v)[3];
    J(0, 2) = J(2, 0) = (*v)[4];
    J(1, 2) = J(2, 1) = (*v)[5];
  }
  return J;
}

struct RigidRead {
  RigidDescription description;
  std::optional<Vec3> centre;
};

RigidRead read_rigid(const ModelInstance& self, YamlSection s) {
  RigidRead r;
  r.description.mass = s.required_number("mass", rules::mass, 1.0);
  if (const auto v = s.get("centre_of_mass")) r.centre = self.read_point(*v);
  if (const auto v = s.get("inertia")) r.description.J_C = read_inertia(*v);
  s.finish();
  return r;
}

/// The part of a body, and whether it is flexible.
struct PartChoice {
  std::optional<YamlValue> value;  ///< of `part`, or of `flexible` alone
  bool on = true;                  ///< flexible: true or false in addition to `part`
  bool valid = true;
};

PartChoice read_choice(YamlSection& s) {
  PartChoice out;
  out.value = s.get("part");
  const auto flexible = s.get("flexible");
  if (!flexible) return out;
  // A switch is true or false, also as the value of an expression.
  std::optional<bool> on;
  const std::size_t before = flexible->context().errors->size();
  if (flexible->is_scalar())
    if (const auto v = flexible->parameter())
      if (const auto* truth = std::get_if<bool>(&*v)) on = *truth;
  if (flexible->context().errors->size() > before) {
    out.valid = false;
    return out;
  }
  if (out.value) {
    if (on)
      out.on = *on;
    else
      flexible->error(ErrorCode::wrong_value,
                      "found " + flexible->found() +
                          " with 'part', expected true or false (or one of the two keys)");
  } else if (on) {
    flexible->error(ErrorCode::incomplete, "found " + flexible->found() +
                                               " without 'part', expected a part: bars, a "
                                               "finite-element file or the name of a body file");
    out.valid = false;
  } else {
    out.value = flexible;
  }
  return out;
}

/// The design pose of a part, which also gives the world positions of its nodes.
void place_part(const ModelInstance& self, YamlSection& s, FlexibleRead& part,
                const std::optional<Vec3>& position, const std::optional<YamlValue>& align,
                double tolerance, BodyDescription& body) {
  if (!part.body) {  // bars are written in the coordinates of the model file
    if (align && part.valid)
      align->error(ErrorCode::exclusive,
                   "found with bars, which are in place already, expected a part from a file");
    body.X_WB.p = position.value_or(part.first_point);
    return;
  }
  body.X_WB.p = position.value_or(Vec3::Zero());
  if (align) {
    for (const char* key : {"position", "orientation"})
      if (s.has(key))
        align->error(ErrorCode::exclusive,
                     std::string("found with '") + key + "', expected one of them");
    if (const auto X = read_alignment(self, *align, tolerance, *part.body))
      body.X_WB = *X;
    else
      part.valid = false;
  }
  for (Vec3& p : part.nodes) p = body.X_WB * p;
}

/// The group that describes the body if both are given: 0 rigid, 1 flexible.
std::optional<std::size_t> read_use(YamlSection& s, bool rigid, bool part) {
  const auto v = s.get("use");
  if (!v) {
    if (rigid && part)
      s.error(ErrorCode::contradiction,
              "found both rigid and flexible, expected a key 'use' with one of them");
    return std::nullopt;
  }
  const auto use = v->word({"rigid", "flexible"});
  if (use && ((*use == 0 && !rigid) || (*use == 1 && !part)))
    v->error(ErrorCode::missing, "found " + std::string(*use == 0 ? "rigid" : "flexible") +
                                     ", but the body has no such group");
  return use;
}

/// Puts a rigid body at its position, or at its centre of mass if none is given.
void place_rigid(YamlSection& s, const YamlValue& group, RigidRead& rigid,
                 const std::optional<Vec3>& position, const std::optional<YamlValue>& align,
                 BodyDescription& body) {
  const Vec3 centre = rigid.centre.value_or(position.value_or(Vec3::Zero()));
  if (!rigid.centre && !group.node().entries.empty() && !s.has("position")) {
    bool given = false;
    for (const YamlEntry& e : group.node().entries) given = given || e.key == "centre_of_mass";
    if (!given)
      s.error(ErrorCode::out_of_range,
              "found neither position nor rigid.centre_of_mass, expected at least one");
  }
  if (align)
    align->error(ErrorCode::wrong_value, "found on a rigid body, expected a part with markers");
  body.X_WB.p = position.value_or(centre);
  rigid.description.p_BC = body.X_WB.R.transpose() * (centre - body.X_WB.p);
  body.kind = rigid.description;
}

/// Locations of the keys of a group, for errors found when the body is built.
void note_keys(const YamlSection& group, Origin& origin) {
  for (const auto& [key, mark] : group.origin().keys) origin.keys.emplace(key, mark);
}

/// The appearance given for a body has priority over that of its file.
void set_shape(BodyDescription& body, std::shared_ptr<const BodyShape> shape) {
  if (auto* rigid = std::get_if<RigidDescription>(&body.kind))
    rigid->shape = std::move(shape);
  else if (auto* part = std::get_if<FlexibleBody>(&body.kind))
    if (!part->shape || part->shape->empty()) part->shape = std::move(shape);
}

void read_body(const ModelInstance& self, const std::string& name, YamlSection& s,
               ReadModel& model) {
  BodyDescription body;
  KnownBody known;
  body.name = self.prefix + name;
  body.origin = s.origin();
  std::optional<Vec3> position;
  if (const auto v = s.get("position")) position = self.read_point(*v);
  if (const auto v = s.get("orientation")) body.X_WB.R = read_orientation(*v, &body.largest_angle);
  const auto rigid_value = s.get("rigid");
  const PartChoice part = read_choice(s);
  const double tolerance = s.number("align_tolerance", positive_number("m"), 1e-6);
  const auto align = s.get("align");
  const auto use = read_use(s, rigid_value.has_value(), part.value.has_value());
  const auto geometry = s.get("geometry");
  if (s.has("geometric_stiffening"))
    body.geometric_stiffening = s.boolean("geometric_stiffening", false);
  s.finish({"rigid.mass", "rigid.centre_of_mass", "rigid.inertia", "flexible.material",
            "flexible.bars", "flexible.masses", "flexible.clamped", "flexible.static_modes",
            "flexible.path_shapes", "flexible.normal_modes", "flexible.mass_model",
            "flexible.damping"});
  if (!rigid_value && !part.value) {
    if (part.valid) s.error(ErrorCode::missing, "missing key 'rigid' or 'flexible'");
    known.valid = false;
  }

  std::optional<RigidRead> rigid;
  std::optional<FlexibleRead> flexible;
  if (rigid_value)
    if (auto group = rigid_value->section("a map with mass, centre_of_mass, inertia")) {
      note_keys(*group, body.origin);
      rigid = read_rigid(self, *group);
      validate_entity(s, body.origin, [&](const validation::Entity& entity) {
        validation::rigid(rigid->description, entity);
      });
    }
  if (part.value) {
    if (part.value->is_map()) {
      YamlSection group(*part.value);
      note_keys(group, body.origin);
      if (const auto material = group.get("material"); material && material->is_map())
        note_keys(YamlSection(*material), body.origin);
    }
    flexible = read_part(self, model, body.name, *part.value);
  }
  if (body.geometric_stiffening && !part.value && part.valid)
    s.error(ErrorCode::wrong_value,
            "found geometric_stiffening on a rigid body, expected it with 'flexible' or 'part'");
  const bool take_part = part.value && (!rigid_value || (use && *use == 1));
  if (take_part) {
    known.flexible = part.on;
    body.rigid = !part.on;
    place_part(self, s, *flexible, position, align, tolerance, body);
    known.valid = flexible->valid;
    known.nodes = std::move(flexible->nodes);
    known.named_nodes = std::move(flexible->named_nodes);
    known.modes = flexible->modes;
    if (flexible->body && !part.on) remove_surface_points(*flexible->body);
    if (flexible->body)
      body.kind = std::move(*flexible->body);
    else
      body.kind = std::move(flexible->description);
  } else if (rigid) {
    place_rigid(s, *rigid_value, *rigid, position, align, body);
  } else {
    known.valid = false;
    body.kind = RigidDescription{};
  }
  if (geometry) set_shape(body, read_body_geometry(self, *geometry));
  body.X_WT = body.X_WB;
  place(body, self.world);
  known.origin = body.X_WB.p;
  known.index = model.description.bodies.size();
  for (Vec3& p : known.nodes) p = self.world.point(p);
  model.bodies.emplace(body.name, std::move(known));
  model.description.bodies.push_back(std::move(body));
}

}  // namespace

std::vector<std::pair<std::string, YamlSection>> active_entities(const ModelInstance& self,
                                                                 EntityKind kind) {
  std::vector<std::pair<std::string, YamlSection>> out;
  if (!self.root) return out;
  YamlSection root = *self.root;
  const auto list = root.get(entity_keys[index_of(kind)]);
  if (!list || !list->is_map()) return out;
  for (const auto& [name, value] : list->named("a map of names")) {
    const auto& names = self.names[index_of(kind)];
    const auto it = names.find(name);
    if (it == names.end() || !it->second) continue;
    auto section = value.section();
    if (!section) continue;
    section->get("when");
    out.emplace_back(name, std::move(*section));
  }
  return out;
}

void read_bodies(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, section] : active_entities(self, EntityKind::body))
    read_body(self, name, section, model);
}

}  // namespace floatframe
