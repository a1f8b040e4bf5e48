#pragma once
// What the mass of a direction of motion is measured against. Coordinates have different units
// (lengths, angles, amplitudes of modes of any normalisation) and bodies different sizes, so that
// entries of the mass matrix cannot be compared with each other: each is held against what the
// bodies that the coordinate moves could give it, their mass times the square of how far it moves
// them. The verdict does not depend on the size of a body or the scale of a mode.
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// The mass of a body; of one without mass, the mean of all.
double possible_mass(const Model& model, std::size_t body);

/// Inertia of one mode of a body: what it has, or its mass at the node that moves most, whose
/// distance from the point that moments are taken about is at most sqrt(reach2).
double possible_modal_mass(const Model& model, std::size_t body, int mode, double reach2);

/// The mass or inertia that each coordinate could have at these positions: the sum of m (v^2 + w^2
/// l^2) over the bodies that a unit velocity moves by v and turns by w, with the characteristic
/// lengths l, and m x^2 for a mode that moves nodes by x. Leaves `f` at other velocities.
VecX possible_masses(RelativeFormulation& f, const State& state);
VecX possible_masses(AbsoluteFormulation& f, const State& state);

/// Scales of coordinates for questions about the mass matrix: its diagonal, but no less than 1e-4
/// of what is possible, so that round-off stays small.
VecX mass_scale(const VecX& diagonal, const VecX& possible);

/// Below this fraction of `mass_scale` a direction has no mass.
inline constexpr double no_mass = 1e-10;

/// Accelerations of single coordinates so large that the forces `r0` do not drown M a, in units in
/// which the possible masses are one.
VecX test_accelerations(const VecX& r0, const VecX& possible);

}  // namespace floatframe
