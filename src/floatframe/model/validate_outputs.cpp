// Result columns: names, measured quantities, components.
#include <algorithm>
#include <set>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/curve_keys.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model/validate_model.hpp"

namespace floatframe::validation {

namespace {

void joint_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(output_type_name(o.type), "joint", o.entity, names.joints)) return;
  const JointType type = d.joints[*names.joints.find(o.entity)].type;
  if (word_complaint(static_cast<int>(type), joint_words)) return;
  const int n = joint_velocities(type);
  if (n == 0)
    entity.error(ErrorCode::wrong_value, output_type_name(o.type), sentences::weld_does_not_move());
  else if (o.component < 0 || o.component >= n) {
    const bool from_file = !o.origin.mark.file.empty();
    entity.error(ErrorCode::out_of_range, from_file ? "coordinate" : "component",
                 sentences::number_of("the number of a coordinate", o.component, n, from_file));
  }
}

void force_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(output_type_name(o.type), "force", o.entity, names.forces)) return;
  const ElementType type = d.forces[*names.forces.find(o.entity)].type();
  if (word_complaint(static_cast<int>(type), element_words)) return;
  if (!element_has(type, output_kind(o.type).needs))
    entity.error(ErrorCode::wrong_value, output_type_name(o.type),
                 sentences::load_without(element_type_name(type), output_type_name(o.type)));
}

void reaction(const OutputDescription& o, const Names& names, const Entity& entity) {
  entity.reference(output_type_name(o.type),
                   o.rod          ? "rod"
                   : o.constraint ? "constraint"
                                  : "joint",
                   o.entity,
                   o.rod          ? names.rods
                   : o.constraint ? names.constraints
                                  : names.joints);
  if (!entity.word("in", o.in, rules::reaction_axes)) return;
  if (o.in == OutputAxes::place)
    entity.place("in", o.to, names);
  else if ((o.rod || o.constraint) && o.in != OutputAxes::world)
    entity.error(ErrorCode::wrong_value, "in", sentences::rod_has_no_axes());
}

/// The point that a torque or an angular momentum is about.
void about(const OutputDescription& o, const Names& names, const Entity& entity) {
  if (!o.about) return;
  if (!output_kind(o.type).about_point)
    entity.error(ErrorCode::incomplete, "about", sentences::force_without_point());
  else
    entity.place("about", output_kind(o.type).of == OutputOf::reaction ? o.at : o.to, names);
}

void frames(const OutputDescription& o, const OutputKind& kind, const Names& names,
            const Entity& entity) {
  const auto frame = [&](const char* key, const std::optional<ReferenceDescription>& x) {
    if (!x) return;
    if (x->place)
      entity.place(key, *x, names);
    else if (x->body != ground_name)
      entity.reference(key, "body", x->body, names.bodies);
  };
  if (o.relative && kind.frames != OutputFrames::relative_to_and_in)
    entity.error(ErrorCode::wrong_value, "relative_to",
                 sentences::without_reference(output_type_name(o.type)));
  else
    frame("relative_to", o.relative);
  if (o.axes && kind.frames == OutputFrames::none)
    entity.error(ErrorCode::wrong_value, "in", sentences::without_axes(output_type_name(o.type)));
  else
    frame("in", o.axes);
}

void gauge(const OutputDescription& o, const Entity& entity) {
  const std::string what = output_type_name(o.type);
  if (o.gauge.node < 0)
    entity.error(ErrorCode::out_of_range, what,
                 "found the node " + std::to_string(o.gauge.node) +
                     ", expected the number of a node in its file, from 1");
  if (!o.at.point.allFinite() || !o.gauge.toward.allFinite() || !o.gauge.along.allFinite())
    entity.error(ErrorCode::not_finite, what, "found a number that is not finite");
  if (o.type == OutputType::strain)
    entity.complain(ErrorCode::geometry, "direction", sentences::direction(o.gauge.direction));
}

void motion_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                   const Entity& entity) {
  const char* const word = output_type_name(o.type);
  if (!entity.reference(word, "joint", o.entity, names.joints)) return;
  const JointDescription& j = d.joints[*names.joints.find(o.entity)];
  const bool driven = std::any_of(j.motions.begin(), j.motions.end(),
                                  [&](const auto& m) { return m.coordinate == o.component; });
  if (!j.motion && !driven)
    entity.error(ErrorCode::wrong_value, word, sentences::joint_without_motion());
}

void path_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                 const Entity& entity) {
  const char* const word = output_type_name(o.type);
  if (!entity.reference(word, "constraint", o.entity, names.constraints)) return;
  if (!has_path(d.constraints[*names.constraints.find(o.entity)].kind))
    entity.error(ErrorCode::wrong_value, word, sentences::no_path(o.entity));
}

void output(const OutputDescription& o, const ModelDescription& d, const Names& names,
            const Entity& entity) {
  const std::string what = output_type_name(o.type);
  const auto moving_body = [&] {
    if (o.at.body == ground_name)
      entity.error(ErrorCode::wrong_value, what, sentences::ground_is_no_body());
    else
      entity.reference(what, "body", o.at.body, names.bodies);
  };
  const OutputKind& kind = output_kind(o.type);
  switch (kind.of) {
    case OutputOf::point:
      entity.place(what, o.at, names);
      break;
    case OutputOf::two_points:
      entity.place(what + ".from", o.at, names);
      entity.place(what + ".to", o.to, names);
      break;
    case OutputOf::gauge:
      moving_body();
      gauge(o, entity);
      break;
    case OutputOf::flexible_point:
      entity.place(what, o.at, names, false);
      break;
    case OutputOf::mass:
      if (!o.whole) moving_body();
      break;
    case OutputOf::body:
    case OutputOf::mode:
      moving_body();  // the number of modes is known when the body is reduced
      break;
    case OutputOf::joint:
      joint_output(o, d, names, entity);
      break;
    case OutputOf::force:
      force_output(o, d, names, entity);
      break;
    case OutputOf::reaction:
      reaction(o, names, entity);
      break;
    case OutputOf::formula:
    case OutputOf::crossing:
      if (!o.formula) entity.error(ErrorCode::missing, what, sentences::missing_formula());
      break;
    case OutputOf::rod:
      entity.reference(what, "rod", o.entity, names.rods);
      break;
    case OutputOf::coupling:
      entity.reference(what, "coupling", o.entity, names.couplings);
      break;
    case OutputOf::path:
      path_output(o, d, names, entity);
      break;
    case OutputOf::controller:
      entity.reference(what, "controller", o.entity, names.controllers);
      break;
    case OutputOf::motion:
      motion_output(o, d, names, entity);
      break;
    case OutputOf::state:  // its number is known when the element is built
      if (!names.controllers.find(o.entity))
        entity.reference(what, "force", o.entity, names.forces);
      break;
  }
  about(o, names, entity);
  frames(o, kind, names, entity);
  if (kind.components.key)
    entity.complain(ErrorCode::wrong_value, kind.components.key,
                    word_complaint(o.component, kind.components.words));
}

}  // namespace

void outputs(const ModelDescription& d, const Names& names, ErrorList& errors) {
  std::set<std::string> taken;
  const auto check = [&](const std::string& list, const OutputDescription& o) {
    const Entity entity{errors, o.origin, list + "." + o.name};
    if (const auto complaint = sentences::column_name(o.name))
      entity.error(ErrorCode::wrong_value, *complaint);
    else if (const auto taken_by = sentences::column_taken(o.name, !taken.insert(o.name).second))
      errors.add(ErrorCode::duplicate, o.origin.mark, list + ": " + *taken_by);
    const auto kind = word_complaint(static_cast<int>(o.type), output_words);
    if (kind)
      entity.error(ErrorCode::wrong_value, *kind);
    else
      output(o, d, names, entity);
  };
  for (const OutputDescription& o : d.outputs) check("outputs", o);
  for (const OutputDescription& o : d.measures) check("measures", o);
}

}  // namespace floatframe::validation
