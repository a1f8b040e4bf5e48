#pragma once

namespace floatframe {

/// Of stiffness and mass of solid elements.
enum class Integration {
  exact,  ///< consistent mass, integrated exactly on elements with straight edges
  ccx     ///< the points of CalculiX 2.20: K and M equal its exported entries
};

}  // namespace floatframe
