// Result columns: names, what they measure, which component.
#include <set>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model/validate.hpp"

namespace floatframe::validation {

namespace {

const char* quantity(OutputKind kind) { return rules::quantities[index_of(kind)]; }

void joint_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(quantity(o.kind), "joint", o.entity, names.joints)) return;
  const JointType type = d.joints[*names.joints.find(o.entity)].type;
  if (word_complaint(static_cast<int>(type), joint_words)) return;
  const int n = joint_velocities(type);
  if (n == 0)
    entity.fault(quantity(o.kind), sentences::weld_does_not_move());
  else if (o.component < 0 || o.component >= n)  // counted from 0 here and from 1 in model files
    entity.fault("coordinate", sentences::number_of("the number of a coordinate", o.component, n));
}

void force_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(quantity(o.kind), "force", o.entity, names.forces)) return;
  const ForceDescription& f = d.forces[*names.forces.find(o.entity)];
  const auto* load = std::get_if<AppliedLoadDescription>(&f.kind);
  if (load && o.kind != OutputKind::force)
    entity.fault(quantity(o.kind),
                 sentences::load_without(load->torque ? "torque" : "force", quantity(o.kind)));
}

void output(const OutputDescription& o, const ModelDescription& d, const Names& names,
            const Entity& entity) {
  const std::string what = quantity(o.kind);
  const auto moving_body = [&] {
    if (o.at.body == ground_name)
      entity.fault(what, sentences::ground_is_no_body());
    else
      entity.reference(what, "body", o.at.body, names.bodies);
  };
  switch (o.kind) {
    case OutputKind::position:
    case OutputKind::velocity:
    case OutputKind::acceleration:
      entity.place(what, o.at, names);
      entity.word("axis", o.component, rules::axes);
      break;
    case OutputKind::rotation:
      moving_body();
      entity.word("angle", o.component, rules::angles);
      break;
    case OutputKind::angular_velocity:
      moving_body();
      entity.word("axis", o.component, rules::axes);
      break;
    case OutputKind::joint_position:
    case OutputKind::joint_velocity:
      joint_output(o, d, names, entity);
      break;
    case OutputKind::modal_amplitude:
      moving_body();  // the number of modes is known when the body is reduced
      break;
    case OutputKind::force:
    case OutputKind::length:
    case OutputKind::rate:
      force_output(o, d, names, entity);
      break;
  }
}

}  // namespace

void outputs(const ModelDescription& d, const Names& names, Faults& faults) {
  std::set<std::string> taken;
  for (const OutputDescription& o : d.outputs) {
    const Entity entity{faults, o.origin, "outputs." + o.name};
    if (const auto complaint = sentences::column_name(o.name))
      entity.fault(*complaint);
    else if (const auto taken_by = sentences::column_taken(o.name, !taken.insert(o.name).second))
      faults.add(o.origin.mark, "outputs: " + *taken_by);
    const auto kind = word_complaint(static_cast<int>(o.kind), rules::quantities);
    if (kind)
      entity.fault(*kind);
    else
      output(o, d, names, entity);
  }
}

}  // namespace floatframe::validation
