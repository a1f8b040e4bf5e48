#pragma once
// Names of the owners of coordinates and constraint rows, for messages and reports. Load time.
#include <string>
#include <vector>

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

/// Of each row of the constraints: "joint 'guide'".
inline std::vector<std::string> constraint_owners(const Formulation& f) {
  std::vector<std::string> owners;
  for (int k = 0; k < f.constraints(); ++k) owners.push_back(f.constraint_set().owner_of_row(k));
  return owners;
}

}  // namespace floatframe
