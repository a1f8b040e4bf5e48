// Result columns: names, what they measure, which component.
#include <set>

#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model/validate.hpp"

namespace floatframe::validation {

namespace {

const char* quantity(OutputKind kind) { return rules::quantities[static_cast<std::size_t>(kind)]; }

void joint_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(quantity(o.kind), "joint", o.entity, names.joints)) return;
  for (const JointDescription& j : d.joints) {
    if (j.name != o.entity || word_complaint(static_cast<int>(j.type), rules::joint_types))
      continue;
    const int n = joint_velocities(j.type);
    if (n == 0) {
      entity.fault(quantity(o.kind), "found a weld, expected a joint that moves");
      return;
    }
    // Counted from 0 here and from 1 in model files.
    if (o.component < 0 || o.component >= n)
      entity.fault("coordinate",
                   sentences::number_of("the number of a coordinate", o.component, n));
    return;
  }
}

void force_output(const OutputDescription& o, const ModelDescription& d, const Names& names,
                  const Entity& entity) {
  if (!entity.reference(quantity(o.kind), "force", o.entity, names.forces)) return;
  for (const ForceDescription& f : d.forces) {
    const auto* load = std::get_if<AppliedLoadDescription>(&f.kind);
    if (f.name == o.entity && load && o.kind != OutputKind::force)
      entity.fault(quantity(o.kind), std::string("a ") + (load->torque ? "torque" : "force") +
                                         " has no " + quantity(o.kind) +
                                         ", expected another force element");
  }
}

void output(const OutputDescription& o, const ModelDescription& d, const Names& names,
            const Entity& entity) {
  const std::string what = quantity(o.kind);
  const auto moving_body = [&] {
    if (o.at.body == ground_name)
      entity.fault(what, "found ground, expected a body");
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
    else if (o.name == "time")
      faults.add(o.origin.mark, "outputs: " + sentences::time_column());
    else if (!taken.insert(o.name).second)
      faults.add(o.origin.mark, "outputs: " + sentences::column_exists(o.name));
    const auto kind = word_complaint(static_cast<int>(o.kind), rules::quantities);
    if (kind)
      entity.fault(*kind);
    else
      output(o, d, names, entity);
  }
}

}  // namespace floatframe::validation
