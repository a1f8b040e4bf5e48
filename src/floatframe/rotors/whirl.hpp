#pragma once
// The motion of a rotor in a mode. At points of its axis, and for its tilts times a length, the
// displacements u_1, u_2 normal to the axis and u_3 along it (complex, e^(lambda t)) sweep the area
//   -2 sum Im(conj(u_1) u_2)
// which, divided by sum |u_1|^2 + |u_2|^2, is -1 for circles against the rotor, 0 for lines and 1
// for circles with it. The component that whirls with the rotor is |u_1 + i u_2|^2 / 2, relative to
// the same sum (1 + whirl) / 2: a force that rotates with the rotor at its axis does work on this
// component only.
//
// If the axis has no lateral displacement, the kinetic energy of the whole rotor, E = 1/2 int
// |u|^2 dm, compared with that of a rigid rotor that moves along and about its axis by the largest
// motion of the axis, distinguishes bending (flap and lag of blades) from motion along and about
// the axis.
#include "floatframe/rotors/turning_model.hpp"

namespace floatframe {

struct SteadyTurning;

/// Components of a mode m in the inertial frame. Rows: displacements of the points in three
/// directions, rotations about the axis times a length.
struct AxisMotion {
  MatX across_1, across_2, along, twist;
  MatX rotor, others;  ///< twice the kinetic energies, forms in the first half of m
  double mass = 0.0;   ///< of the rotor [kg]
  double spin = 0.0;   ///< its moment of inertia about the axis over the square of the length [kg]
};

/// State to which `f` is brought: the steady state.
AxisMotion axis_motion(RelativeFormulation& f, const Rotor& rotor, const SteadyTurning& s);

/// Fills shape, whirl, across, kind, unbalance; both of exact pairs become circular.
void describe_whirl(const AxisMotion& axis, std::vector<TurningMode>& modes);

}  // namespace floatframe
