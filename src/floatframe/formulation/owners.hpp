#pragma once
// Names of the owners of coordinates and constraint rows, for messages and reports. Load time.
#include <map>
#include <string>
#include <vector>

#include "floatframe/description/state_name.hpp"
#include "floatframe/formulation/formulation.hpp"

namespace floatframe {

/// Of each velocity coordinate: "joint 'crank'", "mode 2 of body 'beam'".
inline std::vector<std::string> coordinate_owners(const Formulation& f) {
  std::vector<std::string> owners;
  for (int k = 0; k < f.velocities(); ++k) owners.push_back(f.coordinate_owner(k));
  return owners;
}

/// The same, and behind them "state 2 of bristle_friction 'brake'".
inline std::vector<std::string> unknown_owners(const Formulation& f) {
  std::vector<std::string> owners = coordinate_owners(f);
  for (const Element& e : f.model().elements)
    for (int i = 0; i < e.states; ++i)
      owners.push_back("state " + std::to_string(i + 1) + " of " + element_name(e));
  return owners;
}

/// The owners of unknowns as names; coordinates of one owner count from 0.
inline std::vector<StateName> unknown_names(const Formulation& f) {
  std::map<std::string, StateName> names;
  for (const Joint& j : f.model().joints)
    names["joint '" + j.name + "'"] = {StateKind::joint, j.name};
  for (const Body& b : f.model().bodies) {
    const std::string body = "body '" + b.name + "'";
    names[body] = {StateKind::body, b.name};
    for (int k = 0; k < b.modes(); ++k)
      names["mode " + std::to_string(k + 1) + " of " + body] = {StateKind::mode, b.name, k};
  }
  std::vector<StateName> out;
  for (int k = 0; k < f.velocities(); ++k) {
    const std::string owner = f.coordinate_owner(k);
    const auto known = names.find(owner);
    if (known == names.end()) {
      out.push_back({StateKind::combination, owner});
      continue;
    }
    out.push_back(known->second);
    if (known->second.kind != StateKind::mode) ++known->second.index;
  }
  for (const Element& e : f.model().elements)
    for (int i = 0; i < e.states; ++i) out.push_back({StateKind::element, e.name, i});
  return out;
}

/// Of each row of the constraints: "joint 'guide'".
inline std::vector<std::string> constraint_owners(const Formulation& f) {
  std::vector<std::string> owners;
  for (int k = 0; k < f.constraints(); ++k) owners.push_back(f.constraint_set().owner_of_row(k));
  return owners;
}

}  // namespace floatframe
