#pragma once
// Which way a rotor whirls in a mode. Of points of its axis, and of its tilts times a length, the
// displacements u_1, u_2 across the axis and u_3 along it (complex, e^(lambda t)) sweep the area
//   -2 sum Im(conj(u_1) u_2)
// which is, in parts of sum |u_1|^2 + |u_2|^2, -1 for circles against the rotor, 0 for lines and 1
// for circles with it.
#include "floatframe/simulation/turning_model.hpp"

namespace floatframe {

/// Rows: displacements of the points in three directions, of what a mode is in the world.
struct AxisMotion {
  MatX across_1, across_2, along;
};

/// Fills `whirl` and `across`; of exact pairs of equal frequency both become circular.
void describe_whirl(const AxisMotion& axis, std::vector<TurningMode>& modes);

}  // namespace floatframe
