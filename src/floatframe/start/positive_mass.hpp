#pragma once
// Checks whether the mass matrix of a deformed body is positive definite. Second-order
// displacements enter the coupling of frame and modes and the inertia of the frame, but not the
// mass between modes (inertia/preprocessing.hpp), so that M(y) is positive for small amplitudes
// only. The limit depends on the frame: if it follows a node, the mass in vibrations, M_ff - M_fr
// M_rr^-1 M_rf, is a small difference; in mean axes M_rf is zero without deformation.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Smallest eigenvalue of the mass matrix with a unit diagonal at the amplitudes y (nm), divided by
/// that at y = 0; 1 for a body without second-order displacements, and if masses vanish at y = 0.
double mass_margin(const Body& body, const VecX& y);

/// "the mass matrix of body 'b' is not positive there: ..." with the remedy if the ratio is small,
/// or nothing.
std::string lost_mass(const Body& body, const VecX& y);

}  // namespace floatframe
