#pragma once
// The values of tyres that roll.
#include <string>
#include <vector>

#include "floatframe/description/elements.hpp"

namespace floatframe {

/// The values of a rolling tyre behind its load, in the order of `rolling_values`.
namespace rolling {
enum Value : std::size_t {
  longitudinal_force,
  lateral_force,
  overturning_moment,
  rolling_moment,
  aligning_moment,
  longitudinal_slip,
  slip_angle,
  camber,
  deflection,
  loaded_radius,
  effective_radius,
  contact_x,
  contact_y,
  contact_z,
  friction_use
};
}  // namespace rolling
inline std::vector<std::string> rolling_values(const ElementKeys&) {
  return {"load",           "longitudinal_force", "lateral_force",     "overturning_moment",
          "rolling_moment", "aligning_moment",    "longitudinal_slip", "slip_angle",
          "camber",         "deflection",         "loaded_radius",     "effective_radius",
          "contact_x",      "contact_y",          "contact_z",         "friction_use"};
}

}  // namespace floatframe
