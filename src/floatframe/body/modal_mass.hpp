#pragma once
// Do the modes of a body have independent inertia? The nodes of a coarse mesh have few degrees of
// freedom; modes that are as many as these, together with the rigid motions, have massless
// combinations: the mass matrix
//   M = [M_rr G^T; G M_ff]     of the free rigid motions and the modes
// is singular though every mode alone is valid. The equations of such a model have no unique
// solution: it is rejected.
#include "floatframe/body/inertia_invariants.hpp"

namespace floatframe {

/// M_ff = int X^T X dm = S11 + S22 + S33, nm x nm.
MatX modal_mass(const InertiaInvariants& invariants);

/// 6 x nm: int X dm and int r_u x X dm.
MatX momentum_of_modes(const InertiaInvariants& invariants);

/// M(0), (6 + nm) x (6 + nm): [m I, -skew(m_u), S; . , J, int r_u x X dm; . , . , M_ff] in body
/// axes, the rigid motions at the body origin.
MatX mass_matrix_at_rest(const InertiaInvariants& invariants);

/// Smallest eigenvalue of D^-1/2 (M_ff - G M_rr^+ G^T) D^-1/2, D the diagonal of M_ff, over the
/// modes that have mass; 1 if there are none. Valid bodies have more than 1e-6, singular ones
/// round-off. `free`: the rigid motions that the body can perform, columns (v; w) at the body
/// origin in body axes; those without inertia (a bar about its axis) are omitted. `K`: modal
/// stiffness, which distinguishes a mode of little mass (a rotation of a small body in rad, next to
/// displacements in m) from one without; may be empty.
double relative_modal_mass(const InertiaInvariants& invariants, const Mat6X& free,
                           const MatX& K = MatX());

inline constexpr double least_modal_mass = 1e-9;

}  // namespace floatframe
