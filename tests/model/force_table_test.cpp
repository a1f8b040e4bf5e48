// The tables of force elements in docs/model-file.md are what the list of forces says.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "floatframe/model/force_kind.hpp"
#include "model/table_in_document.hpp"

namespace floatframe {
namespace {

std::string units(const ForceKey& key, const char* form) {
  const auto text = [&](bool turning) {
    const ForceAxisUnits u = force_axis_units(turning);
    std::string s;
    for (const char* c = form; *c; ++c)
      s += *c == 'x'   ? u.displacement
           : *c == 'v' ? u.rate
           : *c == 'F' ? u.force
           : *c == 'k' ? u.stiffness
                       : std::string(1, *c);
    return s;
  };
  return key.axis == ForceAxis::along   ? text(false)
         : key.axis == ForceAxis::about ? text(true)
                                        : text(false) + " or " + text(true);
}

std::string value_text(const ForceKey& key) {
  using K = ForceKeyKind;
  std::string words;
  switch (key.kind) {
    case K::place:
      return "[place](#rods)";
    case K::own_place:
      return "body; and `at`, a point (default: its frame origin), or `node`";
    case K::joint:
      return "joint";
    case K::road:
      return "[road](#roads)";
    case K::direction:
    case K::vector:
      return "direction";
    case K::number:
      return std::string(key.rule.what) + " [" + key.rule.unit + "]";
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
      return "[signal](#inputs) " + units(key, "[F]");
    case K::target:
      return "[signal](#inputs) " + units(key, "[x]");
    case K::target_rate:
      return "[signal](#inputs) " + units(key, "[v]");
    case K::stiffness_matrix:
      return "6 x 6 [N/m, N, N m/m, N m/rad] or 2 x 2 [N/m]";
    case K::damping_matrix:
      return "6 x 6 [N s/m, N s, N m s/m, N m s/rad] or 2 x 2 [N s/m]";
    case K::speed_table:
      return "n x 9 [rad/s, N/m, N s/m]";
  }
  return "";
}

std::string default_text(const ForceKey& key) {
  if (key.required) return "required";
  switch (key.kind) {
    case ForceKeyKind::number:
      return number_text(key.fallback);
    case ForceKeyKind::word:
      return std::string("`") + key.words[key.fallback] + "`";
    case ForceKeyKind::flag:
      return "`false`";
    case ForceKeyKind::direction:
      for (std::size_t i = 0; i < 3; ++i)
        if (key.vector[i] == 1.0) return std::string("`") + "xyz"[i] + "`";
      return "";
    default:
      return "none";
  }
}

std::string results_text(ForceType type) {
  Force force;
  force.type = type;
  std::string s;
  const char* names[] = {"force", "length", "rate"};
  for (const auto quantity : {ForceQuantity::force, ForceQuantity::length, ForceQuantity::rate}) {
    if (!force_has(type, quantity)) continue;
    force.rotational = false;
    const std::string along = force_output_unit(force, quantity);
    force.rotational = true;
    const std::string about = force_output_unit(force, quantity);
    s += std::string(s.empty() ? "`" : ", `") + names[index_of(quantity)] + "` [" + along + "]" +
         (about == along ? "" : " or [" + about + "]");
  }
  return s;
}

TEST(ForceTable, OfTheDocumentationIsThatOfTheList) {
  const std::string head = "| type | what it does | results |\n|---|---|---|\n";
  std::string table = head;
  for (const ForceType type : force_types)
    table += std::string("| `") + force_type_name(type) + "` | " + force_kind(type).about + " | " +
             results_text(type) + " |\n";
  EXPECT_EQ(test::table_in_document(head), table);
}

TEST(ForceTable, KeysOfTheDocumentationAreThoseOfTheList) {
  const std::string head = "| type | key | value | meaning | default |\n|---|---|---|---|---|\n";
  std::string table = head;
  for (const ForceType type : force_types) {
    std::string name = std::string("`") + force_type_name(type) + "`";
    for (const ForceKey& key : force_kind(type).keys) {
      table += "| " + name + " | `" + key.name + "` | " + value_text(key) + " | " + key.about +
               " | " + default_text(key) + " |\n";
      name.clear();
    }
  }
  EXPECT_EQ(test::table_in_document(head), table);
}

}  // namespace
}  // namespace floatframe
