#include "floatframe/vehicle/vehicle_parts.hpp"

#include <algorithm>
#include <cassert>

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

JointDescription* spin_joint(ModelDescription& d, const std::string& name) {
  const auto it = std::ranges::find(d.joints, name, &JointDescription::name);
  const bool spins = it != d.joints.end() && it->type == joint_of_type({}, "revolute").type;
  return spins ? &*it : nullptr;
}

}  // namespace floatframe
