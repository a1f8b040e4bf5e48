#include "floatframe/vehicle/vehicle_parts.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <variant>

#include "floatframe/model/element_keys.hpp"

namespace floatframe {
namespace {

/// The value at the place of a word.
template <class T, std::size_t n>
T of_word(const char* const (&words)[n], const T (&values)[n], std::string_view word) {
  const auto it = std::ranges::find(words, word);
  assert(it != std::end(words));
  return values[it - std::begin(words)];
}

}  // namespace

const BodyDescription& vehicle_body(const ModelDescription& d, const std::string& name) {
  const auto it = std::ranges::find(d.bodies, name, &BodyDescription::name);
  if (it == d.bodies.end())
    throw InputError(ErrorCode::not_found, "vehicle: unknown body '" + name + "'");
  return *it;
}

OutputDescription output_of_type(std::string name, std::string_view type) {
  OutputDescription o;
  o.name = std::move(name);
  o.type = of_word(output_words, output_types, type);
  return o;
}

JointDescription joint_of_type(std::string name, std::string_view type) {
  JointDescription j;
  j.name = std::move(name);
  j.type = of_word(joint_words, joint_types, type);
  return j;
}

InputError vehicle_error(const ModelDescription& d, ErrorCode code, const std::string& path,
                         const std::string& text) {
  const SourceMark mark = d.vehicle ? d.vehicle->origin.mark : SourceMark{};
  return InputError({{mark, code, path + ": " + text, 1, path}});
}

namespace {

/// A place of the tyre is on this body.
bool tyre_acts_on(const ModelDescription& d, const VehicleWheel& wheel, const std::string& body) {
  const auto tyre = std::ranges::find(d.forces, wheel.tyre, &ElementDescription::name);
  if (tyre == d.forces.end()) return false;
  return std::ranges::any_of(element_keys(tyre->type()), [&](const ElementKey& key) {
    if (key.kind != KeyKind::place && key.kind != KeyKind::own_place) return false;
    const std::optional<KeyValue> value = key_value(*tyre, key);
    const auto* place = value ? std::get_if<AttachmentDescription>(&*value) : nullptr;
    return place != nullptr && place->body == body;
  });
}

}  // namespace

JointDescription* spin_joint(ModelDescription& d, const VehicleWheel& wheel) {
  if (wheel.spin.empty()) return nullptr;
  const auto it = std::ranges::find(d.joints, wheel.spin, &JointDescription::name);
  if (it == d.joints.end())
    throw vehicle_error(d, ErrorCode::not_found, "vehicle.axles",
                        "unknown joint '" + wheel.spin + "'");
  if (it->type != joint_of_type({}, "revolute").type)
    throw vehicle_error(d, ErrorCode::wrong_value, "vehicle.axles",
                        "found the " + std::string(joint_type_name(it->type)) + " joint '" +
                            wheel.spin + "' as spin, expected a revolute one");
  if (!tyre_acts_on(d, wheel, it->child.body) && !tyre_acts_on(d, wheel, it->parent.body))
    throw vehicle_error(d, ErrorCode::wrong_value, "vehicle.axles",
                        "found the joint '" + wheel.spin +
                            "' as spin, expected one of the body on which the tyre '" + wheel.tyre +
                            "' acts");
  return &*it;
}

bool spins_as_parent(const ModelDescription& d, const JointDescription& joint,
                     const VehicleWheel& wheel) {
  return !tyre_acts_on(d, wheel, joint.child.body);
}

}  // namespace floatframe
