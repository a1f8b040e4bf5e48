#pragma once
// Unit systems of finite-element files. Most files do not state them, so the user does.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// SI value of one unit; angles are radians everywhere.
struct UnitSystem {
  std::string name = "m-kg-s";
  double length = 1.0;  ///< [m]
  double mass = 1.0;    ///< [kg]
  double time = 1.0;    ///< [s]
  double force() const noexcept { return mass * length / (time * time); }
  double pressure() const noexcept { return mass / (length * time * time); }
  double density() const noexcept { return mass / (length * length * length); }
};

/// "m-kg-s" (also "si"), "mm-t-s", "mm-kg-ms", "mm-kg-s", "mm-g-ms", "cm-g-s", "in-lbf-s" (mass lbf
/// s2/in), "ft-slug-s"; any "<length>-<mass>-<time>" of known units. Case does not matter.
std::optional<UnitSystem> find_unit_system(const std::string& name);
/// For messages and for did-you-mean.
std::vector<std::string> unit_system_names();

/// Converts everything in the model: coordinates, materials, sections, masses, matrices.
void to_si(FeModel& model, const UnitSystem& units);

}  // namespace floatframe
