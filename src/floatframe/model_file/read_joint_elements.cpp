// Elements on coordinates of a joint that its own keys describe: stops, friction. Of a joint with
// one coordinate the key holds the keys of the element, of others a map of coordinates to these.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

struct JointElementKey {
  const char* key;
  ElementType type;
};

std::vector<JointElementKey> keys_with_types() {
  std::vector<JointElementKey> all;
  for (const ElementType type : element_types)
    if (const char* key = element_kind(type).joint_word) all.push_back({key, type});
  return all;
}

/// "slide.stops", or "spindle.displacement.stops" if there are several coordinates
std::string joint_element_name(const std::string& joint, JointType type, int component,
                               const std::string& key) {
  if (joint_has_one_coordinate(type)) return joint + "." + key;
  std::string coordinate = joint_coordinate_key(type, component);
  std::replace(coordinate.begin(), coordinate.end(), ' ', '_');
  return joint + "." + coordinate + "." + key;
}

/// The keys of the element where coordinates are expected, or a coordinate where its keys are;
/// false after an error.
bool has_expected_level(const YamlValue& value, ElementType element, JointType type) {
  const auto holds = [&](const std::string& key) {
    return std::ranges::any_of(value.node().entries,
                               [&](const YamlEntry& e) { return e.key == key; });
  };
  if (!value.is_map()) return true;
  if (joint_has_one_coordinate(type)) {
    const std::string key = joint_coordinate_key(type, 0);
    if (!holds(key)) return true;
    value.error(ErrorCode::unknown_key,
                fmt::format("found the coordinate '{}', expected the keys themselves: a {} joint "
                            "has one coordinate",
                            key, joint_type_name(type)));
    return false;
  }
  std::vector<std::string> coordinates;
  for (int k = 0; k < joint_velocities(type); ++k) {
    if (holds(joint_coordinate_key(type, k))) return true;
    if (!is_of_rotation_vector(type, k)) coordinates.push_back(joint_coordinate_key(type, k));
  }
  std::vector<const char*> words;
  for (const std::string& key : coordinates) words.push_back(key.c_str());
  for (const ElementKey& key : element_keys(element))
    if (!words.empty() && holds(key.name)) {
      value.error(ErrorCode::unknown_key,
                  fmt::format("found the key '{}', expected a map of coordinates of a {} joint to "
                              "such keys: {}",
                              key.name, joint_type_name(type), alternatives(words)));
      return false;
    }
  return true;
}

}  // namespace

std::vector<const char*> joint_element_keys() {
  std::vector<const char*> all;
  for (const JointElementKey& k : keys_with_types()) all.push_back(k.key);
  return all;
}

std::vector<std::string> joint_element_names(const std::string& joint, const YamlNode& keys) {
  const auto entry = [](const YamlNode& node, const std::string& key) -> const YamlNode* {
    const auto it = std::find_if(node.entries.begin(), node.entries.end(),
                                 [&](const YamlEntry& e) { return e.key == key; });
    return it == node.entries.end() ? nullptr : &it->value;
  };
  const YamlNode* word = entry(keys, "type");
  std::vector<std::string> names;
  for (const JointType type : joint_types) {
    if (!word || word->text != joint_type_name(type)) continue;
    for (const char* key : joint_element_keys()) {
      const YamlNode* value = entry(keys, key);
      for (int k = 0; value && k < joint_velocities(type); ++k)
        if (joint_has_one_coordinate(type) || entry(*value, joint_coordinate_key(type, k)))
          names.push_back(joint_element_name(joint, type, k, key));
    }
  }
  return names;
}

void read_joint_elements(const ModelInstance& self, const std::string& joint, JointType type,
                         YamlSection& section, ReadModel& model) {
  for (const auto& [key, element] : keys_with_types()) {
    const auto add = [&, word = key, made = element](YamlSection& own, int component) {
      const CoordinateTerm on{self.prefix + joint, component};
      ElementDescription e = read_element(self, joint_element_name(joint, type, component, word),
                                          own, made, model, &on);
      model.element_types.emplace(e.name, made);
      model.description.forces.push_back(std::move(e));
    };
    const auto value = section.get(key);
    if (!value) continue;
    if (joint_velocities(type) == 0) {
      value->error(ErrorCode::wrong_value, sentences::not_used_by_joint(joint_type_name(type)));
    } else if (!has_expected_level(*value, element, type)) {
      continue;
    } else if (joint_has_one_coordinate(type)) {
      if (auto own = value->section()) add(*own, 0);
    } else if (auto of = value->section("a map of coordinates to maps of keys")) {
      for (int k = 0; k < joint_velocities(type); ++k) {
        const auto v = of->get(joint_coordinate_key(type, k).c_str());
        if (v && is_of_rotation_vector(type, k))
          v->error(ErrorCode::unsupported,
                   sentences::coordinate_of_rotation_vector(joint_type_name(type)));
        else if (auto own = v ? v->section() : std::nullopt)
          add(*own, k);
      }
      of->finish();
    }
  }
}

}  // namespace floatframe
