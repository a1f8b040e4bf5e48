#pragma once
// The values of tyres that roll.
#include <vector>

#include "floatframe/model/element_outputs.hpp"

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
inline std::vector<ElementValue> rolling_values(const ElementKeys&) {
  return {{"load", "N"},
          {"longitudinal_force", "N"},
          {"lateral_force", "N"},
          {"overturning_moment", "N m"},
          {"rolling_moment", "N m"},
          {"aligning_moment", "N m"},
          {"longitudinal_slip", "-"},
          {"slip_angle", "rad"},
          {"camber", "rad"},
          {"deflection", "m"},
          {"loaded_radius", "m"},
          {"effective_radius", "m"},
          {"contact_x", "m"},
          {"contact_y", "m"},
          {"contact_z", "m"},
          {"friction_use", "-"}};
}

}  // namespace floatframe
