#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"

namespace floatframe::sentences {

std::string number_of(const char* what, int component, int n, bool from_file) {
  const int first = from_file ? 1 : 0;
  return "found " + std::to_string(component + first) + ", expected " +
         WholeNumberRule{what, first, n - 1 + first}.expectation();
}

std::string weld_does_not_move() { return "found a weld, expected a joint that moves"; }

std::string joint_without_motion() {
  return "found a joint that moves freely, expected one with a prescribed motion";
}

std::string rod_has_no_axes() {
  return "rods and constraints have no axes of their own, expected world or a place {body, at}";
}

std::string force_without_point() {
  return "found a point for what is the same about every point, expected it with joint_torque or "
         "angular_momentum only";
}

std::string without_mass(bool whole) {
  return whole ? "found a model without mass, expected one with"
               : "found a body without mass, expected one with";
}

std::string without_axes(const std::string& quantity) {
  return "a " + quantity + " has no axes, expected it without the key";
}

std::string without_reference(const std::string& quantity) {
  return "a " + quantity + " is relative to nothing, expected it without the key";
}

std::string load_without(const std::string& type, const std::string& quantity) {
  return "a " + type + " has no " + quantity + ", expected another force element";
}

Complaint column_name(const std::string& name) {
  if (name.empty()) return "found an empty name, expected a column name";
  if (name.size() > rules::column_length)
    return "found a name of " + std::to_string(name.size()) + " characters, expected at most " +
           std::to_string(rules::column_length);
  if (name.find_first_of(",\"[]") == std::string::npos && printable(name) == name)
    return std::nullopt;
  return "expected a column name without commas, quotes, brackets and control characters";
}

Complaint column_taken(const std::string& name, bool exists) {
  if (name == "time")
    return "found the column 'time', the name of the first column, expected another";
  if (exists) return "the column '" + name + "' exists already";
  return std::nullopt;
}

}  // namespace floatframe::sentences
