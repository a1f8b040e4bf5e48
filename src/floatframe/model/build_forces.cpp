// Force elements of the description: their markers, laws and parameters.
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

/// One description on its way to a Force; `build` returns false after a fault.
struct ForceBuild {
  ModelBuilder& builder;
  const Origin& origin;
  const std::string who;
  Force force;

  /// `key` holds the place; nullptr: the place stands among the keys of the force itself.
  int marker(const AttachmentDescription& at, bool oriented, const char* key) {
    return builder.add_marker(at, Mat3::Identity(), oriented,
                              origin.of(key       ? key
                                        : at.node ? "node"
                                                  : "at"),
                              key ? who + "." + key : who);
  }
  /// -1 without an input.
  int input(const SignalDescription& signal) { return builder.input_names.index(signal.input); }
  void actuate(const std::optional<SignalDescription>& signal) {
    if (!signal) return;
    force.magnitude = *signal;
    force.input = input(*signal);
    force.driven = true;
  }
  bool build(const SpringDamperDescription& d) {
    force.type = ForceType::spring_damper;
    force.a = marker(d.a, false, "from");
    force.b = marker(d.b, false, "to");
    force.spring = d.spring;
    force.damper = d.damper;
    actuate(d.actuator);
    return force.a >= 0 && force.b >= 0;
  }

  bool build(const GuidedSpringDescription& d) {
    force.type = ForceType::guided_spring;
    force.a = marker(d.reference, true, "reference");
    force.b = marker(d.tip, false, "tip");
    force.axis = unit_vector(d.axis);
    force.spring = d.spring;
    force.damper = d.damper;
    actuate(d.actuator);
    return force.a >= 0 && force.b >= 0;
  }

  bool build(const JointSpringDescription& d) {
    force.type = ForceType::joint_spring;
    force.spring = d.spring;
    force.damper = d.damper;
    actuate(d.actuator);
    if (d.target) force.target = {*d.target, input(*d.target)};
    if (d.target_rate) force.target_rate = {*d.target_rate, input(*d.target_rate)};
    force.targeted = d.target || d.target_rate;
    force.derived_rate = !d.target_rate;
    const auto k = builder.joint_names.find(d.joint);
    if (!k) return false;  // the joint has an error of its own
    const Joint& joint = builder.model.joints[*k];
    force.a = joint.frame_F;
    force.b = joint.frame_M;
    force.rotational = joint_unit(joint.type, 0) == JointUnit::rad;
    return true;
  }

  bool build(const TyreDescription& d) {
    force.type = ForceType::tyre;
    force.b = marker(d.centre, d.law == TyreLaw::radial, nullptr);
    force.radius = d.radius;
    force.stiffness = d.stiffness;
    force.damping = d.damping;
    force.law = d.law;
    force.axis = unit_vector(d.axis);
    force.road = builder.road_names.index(d.road);
    return force.b >= 0;
  }

  bool build(const AppliedLoadDescription& d) {
    force.type = d.torque ? ForceType::torque : ForceType::force;
    force.b = marker(d.at, d.torque || d.follows, nullptr);
    force.axis = d.direction;
    force.magnitude = d.magnitude;
    force.input = input(d.magnitude);
    force.follows = d.follows;
    return force.b >= 0;
  }
};

}  // namespace

void ModelBuilder::forces() {
  for (const ForceDescription& f : d.forces) {
    ForceBuild b{*this, f.origin, "forces." + f.name, {}};
    b.force.name = f.name;
    if (!std::visit([&](const auto& kind) { return b.build(kind); }, f.kind)) continue;
    force_names.add(f.name);
    model.forces.push_back(std::move(b.force));
  }
}

}  // namespace floatframe
