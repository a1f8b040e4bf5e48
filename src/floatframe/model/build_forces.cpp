// Force elements of the description: their markers, laws and parameters.
#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

ForceBuild::ForceBuild(ModelBuilder& builder, const ForceDescription& description)
    : ForceView(description), builder_(builder) {
  force.name = description.name;
  force.type = description.type();
}

int ForceBuild::marker(const std::string& key, bool oriented, const Mat3& R) const {
  const AttachmentDescription at = place(key);
  const Origin& origin = description().origin;
  const std::string who = "forces." + description().name;
  if (this->key(key).kind == ForceKeyKind::own_place)
    return builder_.add_marker(at, R, oriented, origin.of(at.node ? "node" : "at"), who);
  return builder_.add_marker(at, R, oriented, origin.of(key), who + "." + key);
}

Signal ForceBuild::built_signal(const std::string& key) const {
  const SignalDescription s = signal(key).value_or(SignalDescription());
  return {s, builder_.input_names.index(s.input)};
}

void ForceBuild::actuate(const std::string& key) {
  if (!has(key)) return;
  const Signal s = built_signal(key);
  force.magnitude = s.function;
  force.input = s.input;
  force.driven = true;
}

void ForceBuild::spring_damper_actuator() {
  force.spring = law("spring");
  force.damper = law("damper");
  actuate("actuator");
}

bool ForceBuild::load(bool oriented) {
  force.b = marker("body", oriented);
  force.axis = direction("direction");
  const Signal s = built_signal("magnitude");
  force.magnitude = s.function;
  force.input = s.input;
  force.follows = flag("follows");
  return force.b >= 0;
}

int ForceBuild::road(const std::string& key) const { return builder_.road_names.index(text(key)); }

const Joint* ForceBuild::joint(const std::string& key) const {
  const auto k = builder_.joint_names.find(text(key));
  return k ? &builder_.model.joints[*k] : nullptr;
}

Vec3 ForceBuild::unit_direction(const std::string& key) const {
  return unit_vector(direction(key));
}

void ModelBuilder::forces() {
  for (const ForceDescription& f : d.forces) {
    ForceBuild b(*this, f);
    if (!force_kind(f.type()).build(b)) continue;
    force_names.add(f.name);
    model.forces.push_back(std::move(b.force));
  }
}

}  // namespace floatframe
