#pragma once
// Reference values for the mass of a direction of motion. Coordinates have different units
// (lengths, angles, amplitudes of modes of any normalisation) and bodies different sizes, so that
// entries of the mass matrix cannot be compared with each other. Each is compared with the mass
// that the bodies moved by the coordinate could contribute: their mass times the square of their
// displacement. The result does not depend on the size of a body or the scale of a mode.
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// The mass of a body; for a massless body, the mean of all.
double possible_mass(const Model& model, std::size_t body);

/// Inertia of one mode of a body: its actual value, or its mass at the node with the largest
/// motion, whose distance from the reference point of moments is at most sqrt(reach2).
double possible_modal_mass(const Model& model, std::size_t body, int mode, double reach2);

/// The mass or inertia that each coordinate could have at these positions: the sum of m (v^2 + w^2
/// l^2) over the bodies that a unit velocity moves by v and rotates by w, with the characteristic
/// lengths l, and m x^2 for a mode that moves nodes by x. Changes the velocities of `f`.
VecX possible_masses(Formulation& f, const State& state);

/// Scales of coordinates for tests of the mass matrix: its diagonal, but at least 1e-4 of the
/// possible mass, so that round-off stays small.
VecX mass_scale(const VecX& diagonal, const VecX& possible);

/// Below this fraction of `mass_scale` a direction has no mass.
inline constexpr double no_mass = 1e-10;

/// Accelerations of single coordinates, large enough that M a is not lost in the round-off of `r0`,
/// in units in which the possible masses are one.
VecX test_accelerations(const VecX& r0, const VecX& possible);

}  // namespace floatframe
