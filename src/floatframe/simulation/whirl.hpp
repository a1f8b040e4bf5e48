#pragma once
// How a rotor moves in a mode. Of points of its axis, and of its tilts times a length, the
// displacements u_1, u_2 across the axis and u_3 along it (complex, e^(lambda t)) sweep the area
//   -2 sum Im(conj(u_1) u_2)
// which is, in parts of sum |u_1|^2 + |u_2|^2, -1 for circles against the rotor, 0 for lines and 1
// for circles with it. The part of the motion that goes with the rotor is |u_1 + i u_2|^2 / 2, in
// parts of the same sum (1 + whirl) / 2: a force that turns with the rotor at its axis does work on
// that part alone.
//
// Where the axis does not move across itself, the kinetic energy of the whole rotor,
// E = 1/2 int |u|^2 dm, against that of a rigid rotor that moves along its axis and about it as far
// as the axis does anywhere says whether it bends (flap and lag of blades) or moves along and about
// its axis.
#include "floatframe/simulation/turning_model.hpp"

namespace floatframe {

struct SteadyTurning;

/// Of what a mode is in the world, m. Rows: displacements of the points in three directions,
/// rotations about the axis times a length.
struct AxisMotion {
  MatX across_1, across_2, along, twist;
  MatX rotor, others;  ///< twice the kinetic energies, forms in the first half of m
  double mass = 0.0;   ///< of the rotor [kg]
  double spin = 0.0;   ///< its moment of inertia about the axis over the square of the length [kg]
};

/// Where `f` is brought: the steady state.
AxisMotion axis_motion(RelativeFormulation& f, const Rotor& rotor, const SteadyTurning& s);

/// Fills shape, whirl, across, kind, unbalance; both of exact pairs become circular.
void describe_whirl(const AxisMotion& axis, std::vector<TurningMode>& modes);

}  // namespace floatframe
