// Result columns: what they measure and their units.
#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

void ModelBuilder::outputs() {
  static const char* const units[] = {"m", "m/s", "m/s2", "rad", "rad/s", "",
                                      "",  "",    "N",    "m",   "m/s"};
  for (const OutputDescription& o : d.outputs) {
    Output out;
    out.name = o.name;
    out.kind = o.kind;
    out.component = o.component;
    out.unit = units[static_cast<int>(o.kind)];
    const std::string who = "outputs." + o.name;
    switch (o.kind) {
      case OutputKind::position:
      case OutputKind::velocity:
      case OutputKind::acceleration:
        out.marker = add_marker(o.at, Mat3::Identity(), false, o.origin.mark,
                                who + "." + rules::quantities[index_of(o.kind)]);
        if (out.marker < 0) continue;
        break;
      case OutputKind::rotation:
      case OutputKind::angular_velocity:
      case OutputKind::modal_amplitude:
        out.body = body_index(o.at.body);
        if (o.kind == OutputKind::modal_amplitude) {
          const int nm = model.bodies[out.body].modes();
          if (o.component < 0 || o.component >= nm) {
            faults.add(
                o.origin.mark,
                who + ".mode: " + sentences::number_of("the number of a mode", o.component, nm));
            continue;
          }
          out.unit = "-";
        }
        break;
      case OutputKind::joint_position:
      case OutputKind::joint_velocity: {
        out.joint = joint_names.index(o.entity);
        if (out.joint < 0) continue;  // it has an error of its own
        const JointType type = model.joints[out.joint].type;
        out.unit = joint_unit_name(type, o.component, o.kind == OutputKind::joint_velocity);
        break;
      }
      case OutputKind::force:
      case OutputKind::length:
      case OutputKind::rate: {
        out.force = force_names.index(o.entity);
        if (out.force < 0) continue;  // it has an error of its own
        const Force& f = model.forces[out.force];
        if (f.rotational || f.type == ForceType::torque)
          out.unit = o.kind == OutputKind::force    ? "N m"
                     : o.kind == OutputKind::length ? "rad"
                                                    : "rad/s";
        break;
      }
    }
    model.outputs.push_back(std::move(out));
  }
}

}  // namespace floatframe
