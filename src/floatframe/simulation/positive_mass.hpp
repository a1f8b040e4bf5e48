#pragma once
// Whether the mass matrix of a deformed body is positive. Displacements of second order count in
// the coupling of its frame and its modes and in the inertia of the frame, but not in the mass of
// the modes among each other (inertia/preprocessing.hpp), so that M(y) is positive for small
// amplitudes only. How small depends on the frame: in one that follows a node what vibrations feel,
// M_ff - M_fr M_rr^-1 M_rf, is a small difference; in mean axes M_rf is zero without deformation.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Smallest eigenvalue of the mass matrix with a unit diagonal at the amplitudes y (nm), over that
/// at y = 0; 1 for a body without displacements of second order, and where masses vanish at y = 0.
double mass_margin(const Body& body, const VecX& y);

/// "the mass matrix of body 'b' is not positive there: ..." with the remedy if little is left of
/// it, or nothing.
std::string lost_mass(const Body& body, const VecX& y);

}  // namespace floatframe
