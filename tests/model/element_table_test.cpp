// The tables of force elements in docs/model-file.md are what the list of forces says.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "floatframe/model/element_kind.hpp"
#include "model/table_in_document.hpp"

namespace floatframe {
namespace {

std::string units(const ElementKey& key, const char* form) {
  const auto text = [&](bool turning) {
    const AxisUnits u = axis_units(turning);
    std::string s;
    for (const char* c = form; *c; ++c)
      s += *c == 'x'   ? u.displacement
           : *c == 'v' ? u.rate
           : *c == 'F' ? u.force
           : *c == 'k' ? u.stiffness
                       : std::string(1, *c);
    return s;
  };
  return key.axis == ElementAxis::along   ? text(false)
         : key.axis == ElementAxis::about ? text(true)
                                          : text(false) + " or " + text(true);
}

std::string signal_text(const ElementKey& key, const char* form) {
  const std::string signal = "[signal](#inputs)";
  return key.axis == ElementAxis::none ? signal : signal + " " + units(key, form);
}

std::string number_rule_text(const ElementKey& key) {
  return key.rule.what + (*key.rule.unit ? std::string(" [") + key.rule.unit + "]" : "");
}

std::string value_text(const ElementKey& key) {
  using K = KeyKind;
  std::string words;
  switch (key.kind) {
    case K::place:
      return "[place](#rods)";
    case K::own_place:
      return "body; and `at`, a point (default: its frame origin), or `node`";
    case K::joint:
      return "joint";
    case K::own_coordinate:
      return "name of one of its [coordinates](#joints)";
    case K::road:
      return "[road](#roads)";
    case K::direction:
    case K::vector:
      return "direction";
    case K::number:
      return number_rule_text(key);
    case K::word:
      for (const char* word : key.words)
        words += std::string(words.empty() ? "`" : ", `") + word + "`";
      return words;
    case K::flag:
      return "`true` or `false`";
    case K::spring:
      return "[law](#laws) " + units(key, "[x] -> [F]");
    case K::damper:
      return "[law](#laws) " + units(key, "[v] -> [F]");
    case K::bump_stop:
    case K::rebound_stop:
      return "`{length, stiffness}` " + units(key, "[x], [k]");
    case K::load:
      return signal_text(key, "[F]");
    case K::target:
      return signal_text(key, "[x]");
    case K::target_rate:
      return signal_text(key, "[v]");
    case K::signals:
      return "list of [signals](#inputs)";
    case K::matrix:
      return "numbers, or rows of numbers";
    case K::names:
      return "list of names";
    case K::linear_file:
      return "a `.npz` or `.mat` of [`linearize`](vibrations.md)";
    case K::motion:
      return "[function of time](#functions-of-time) " + units(key, "[x]");
    case K::terms:
      return "list of `{joint, coordinate, factor}`";
    case K::coordinate:
      return std::string("joint") +
             (key.axis == ElementAxis::about   ? " that turns"
              : key.axis == ElementAxis::along ? " that slides"
                                               : "") +
             ", or `{joint, coordinate}`";
    case K::numbers:
      for (const char* word : key.words) words += (words.empty() ? "" : ", ") + std::string(word);
      return "`[" + words + "]`, each " + number_rule_text(key);
    case K::function:
      return "function of a program, or `{formula}`";
    case K::formula:
      return "[formula](#formulas)";
    case K::stiffness_matrix:
      return "6 x 6 [N/m, N, N m/m, N m/rad] or 2 x 2 [N/m]";
    case K::damping_matrix:
      return "6 x 6 [N s/m, N s, N m s/m, N m s/rad] or 2 x 2 [N s/m]";
    case K::speed_table:
      return "n x 9 [rad/s, N/m, N s/m]";
    case K::points:
      for (const char* word : key.words) words += (words.empty() ? "" : ", ") + std::string(word);
      return "rows [" + words + "], or a [file](#tables-from-files)";
    case K::shape:
      return "[formula](#formulas) of `" + std::string(key.words[0]) + "`";
    case K::table:
      for (const char* word : key.words) words += (words.empty() ? "" : ", ") + std::string(word);
      return "rows [" + words + "]";
  }
  return "";
}

std::string default_text(const ElementKey& key) {
  if (key.required) return "required";
  switch (key.kind) {
    case KeyKind::number:
      return std::isnan(key.fallback) ? "none" : number_text(key.fallback);
    case KeyKind::word:
      return std::string("`") + key.words[key.fallback] + "`";
    case KeyKind::flag:
      return key.fallback == 0.0 ? "`false`" : "`true`";
    case KeyKind::direction:
      for (std::size_t i = 0; i < 3; ++i)
        if (key.vector[i] == 1.0) return std::string("`") + "xyz"[i] + "`";
      return "";
    default:
      return "none";
  }
}

std::string results_text(ElementType type) {
  Element force;
  force.type = type;
  std::string s;
  const char* names[] = {"force", "length", "rate"};
  for (const auto quantity :
       {ElementQuantity::force, ElementQuantity::length, ElementQuantity::rate}) {
    if (!element_has(type, quantity)) continue;
    force.rotational = false;
    const std::string along = element_output_unit(force, quantity);
    force.rotational = true;
    const std::string about = element_output_unit(force, quantity);
    s += std::string(s.empty() ? "`" : ", `") + names[index_of(quantity)] + "` [" + along + "]" +
         (about == along ? "" : " or [" + about + "]");
  }
  return s;
}

/// The lists with types, and their word in the tables.
constexpr std::pair<ElementList, const char*> typed_lists[] = {
    {ElementList::forces, "type"},
    {ElementList::controllers, "controller"},
    {ElementList::couplings, "coupling"},
    {ElementList::constraints, "constraint"}};

std::string results_of(ElementList list, ElementType type) {
  if (list == ElementList::controllers) return "`controller` [-]";
  if (list == ElementList::constraints) return "`joint_force` [N], `joint_torque` [N m]";
  if (list == ElementList::couplings) return "`coupling_force` [N] or [N m]";
  return results_text(type);
}

TEST(ElementTable, OfTheDocumentationIsThatOfTheList) {
  for (const auto& [list, word] : typed_lists) {
    const std::string head =
        std::string("| ") + word + " | what it does | results |\n|---|---|---|\n";
    std::string table = head;
    for (const ElementType type : types_of(list))
      table += std::string("| `") + element_type_name(type) + "` | " + element_kind(type).about +
               " | " + results_of(list, type) + " |\n";
    EXPECT_EQ(test::table_in_document(head), table);
  }
}

TEST(ElementTable, KeysOfTheDocumentationAreThoseOfTheList) {
  for (const auto& [list, word] : typed_lists) {
    const std::string head =
        std::string("| ") + word + " | key | value | meaning | default |\n|---|---|---|---|---|\n";
    std::string table = head;
    for (const ElementType type : types_of(list)) {
      std::string name = std::string("`") + element_type_name(type) + "`";
      for (const ElementKey& key : element_kind(type).keys) {
        table += "| " + name + " | `" + key.name + "` | " + value_text(key) + " | " + key.about +
                 " | " + default_text(key) + " |\n";
        name.clear();
      }
    }
    EXPECT_EQ(test::table_in_document(head), table);
  }
}

}  // namespace
}  // namespace floatframe
