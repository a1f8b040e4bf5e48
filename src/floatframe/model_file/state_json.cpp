#include "floatframe/model_file/state_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/json_text.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr int state_version = 1;

template <class Numbers>
Json array_of(const Numbers& v) {
  Json array = Json::array();
  for (const double x : v) array.push_back(x);
  return array;
}

/// Converts a file to a state; errors contain the path inside the file.
class StateReader {
 public:
  explicit StateReader(std::string file) : file_(std::move(file)) {}

  SystemState read() {
    ErrorList errors;
    std::string text;
    if (!read_text_file(file_, text, errors, {}, "")) errors.throw_if_any();
    std::string why;
    const Json json = read_json(text, why);
    if (json.is_discarded()) fail(ErrorCode::wrong_file, "this is not a state file (" + why + ")");
    if (!json.is_object() || !json.contains("floatframe_state"))
      fail(ErrorCode::wrong_file, "this is not a state file (it has no key 'floatframe_state')");
    const Json& number = json.at("floatframe_state");
    if (!number.is_number_integer() || number.get<long>() != state_version)
      fail(ErrorCode::mismatch,
           "floatframe_state: found " + json_excerpt(number) + ", this program reads version 1");
    SystemState s;
    s.file = file_;
    s.model = text_of(json, "model");
    s.time = number_of(member(json, "time", ""), "time");
    for (const auto& [name, value] : members(json, "joints")) {
      const std::string path = "joints." + excerpt(name);
      SystemState::Joint j;
      j.name = name;
      const std::string type = text_of(value, "type", path);
      std::size_t k = 0;
      while (k < std::size(joint_words) && type != joint_words[k]) ++k;
      if (k == std::size(joint_words))
        fail(ErrorCode::wrong_value,
             path + ".type: found '" + excerpt(type) + "', expected " + alternatives(joint_words));
      j.type = static_cast<JointType>(k);
      j.position = list(value, "position", path);
      j.velocity = list(value, "velocity", path);
      s.joints.push_back(std::move(j));
    }
    for (const auto& [name, value] : members(json, "bodies")) {
      const std::string path = "bodies." + excerpt(name);
      SystemState::Body b;
      b.name = name;
      b.position = fixed<3>(value, "position", path);
      b.orientation = fixed<4>(value, "quaternion", path);
      if (std::abs(b.orientation.norm() - 1.0) > 1e-6)
        fail(ErrorCode::wrong_value, path + ".quaternion: found a quaternion of length " +
                                         number_text(std::round(b.orientation.norm() * 1e6) / 1e6) +
                                         ", expected length 1");
      b.velocity = fixed<3>(value, "velocity", path);
      b.angular_velocity = fixed<3>(value, "angular_velocity", path);
      b.amplitudes = vector(value, "amplitudes", path);
      b.amplitude_rates = vector(value, "amplitude_rates", path);
      s.bodies.push_back(std::move(b));
    }
    if (json.contains("elements"))  // only of models whose elements have states
      for (const auto& [name, value] : members(json, "elements"))
        s.elements.push_back({name, vector(value, "states", "elements." + excerpt(name))});
    return s;
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const std::string& sentence) const {
    throw InputError(code, {file_, 0, 0}, sentence);
  }
  const Json& member(const Json& object, const char* key, const std::string& path) const {
    const std::string who = path.empty() ? std::string() : path + ": ";
    if (!object.is_object())
      fail(ErrorCode::missing, who + "found no map, expected one with the key '" + key + "'");
    const auto it = object.find(key);
    if (it == object.end())
      fail(ErrorCode::missing, who + "missing key '" + std::string(key) + "'");
    return *it;
  }
  std::string text_of(const Json& object, const char* key, const std::string& path = "") const {
    const Json& v = member(object, key, path);
    if (!v.is_string()) fail(ErrorCode::wrong_value, inside(path, key) + ": expected a text");
    return v.get<std::string>();
  }
  double number_of(const Json& v, const std::string& path) const {
    if (!v.is_number() || !std::isfinite(v.get<double>()))
      fail(ErrorCode::out_of_range, path + ": found " + json_excerpt(v) + ", expected a number");
    return v.get<double>();
  }
  std::vector<std::pair<std::string, Json>> members(const Json& json, const char* key) const {
    const Json& v = member(json, key, "");
    if (!v.is_object())
      fail(ErrorCode::wrong_value, std::string(key) + ": expected a map of names");
    std::vector<std::pair<std::string, Json>> out;
    for (const auto& [name, value] : v.items()) out.emplace_back(name, value);
    return out;
  }
  std::vector<double> list(const Json& object, const char* key, const std::string& path) const {
    const Json& v = member(object, key, path);
    if (!v.is_array())
      fail(ErrorCode::wrong_count, inside(path, key) + ": expected a list of numbers");
    std::vector<double> out;
    for (const Json& x : v) out.push_back(number_of(x, inside(path, key)));
    return out;
  }
  template <int n>
  Eigen::Matrix<double, n, 1> fixed(const Json& object, const char* key,
                                    const std::string& path) const {
    const std::vector<double> v = list(object, key, path);
    if (v.size() != n)
      fail(ErrorCode::wrong_count, inside(path, key) + ": found a list of " +
                                       std::to_string(v.size()) + ", expected a list of " +
                                       std::to_string(n) + " numbers");
    return Eigen::Map<const Eigen::Matrix<double, n, 1>>(v.data());
  }
  VecX vector(const Json& object, const char* key, const std::string& path) const {
    const std::vector<double> v = list(object, key, path);
    return Eigen::Map<const VecX>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
  static std::string inside(const std::string& path, const char* key) {
    return path.empty() ? std::string(key) : path + "." + key;
  }

  std::string file_;
};

}  // namespace

std::string state_json(const SystemState& s) {
  Json joints = Json::object(), bodies = Json::object();
  for (const SystemState::Joint& j : s.joints)
    joints[j.name] = {{"type", joint_type_name(j.type)},
                      {"position", array_of(j.position)},
                      {"velocity", array_of(j.velocity)}};
  for (const SystemState::Body& b : s.bodies)
    bodies[b.name] = {
        {"position", array_of(b.position)},     {"quaternion", array_of(b.orientation)},
        {"velocity", array_of(b.velocity)},     {"angular_velocity", array_of(b.angular_velocity)},
        {"amplitudes", array_of(b.amplitudes)}, {"amplitude_rates", array_of(b.amplitude_rates)}};
  Json json = {{"floatframe_state", state_version},
               {"model", s.model},
               {"time", s.time},
               {"joints", joints},
               {"bodies", bodies}};
  for (const SystemState::Element& e : s.elements)
    json["elements"][e.name] = {{"states", array_of(e.states)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

SystemState read_state(const std::string& path) { return StateReader(path).read(); }

}  // namespace floatframe
