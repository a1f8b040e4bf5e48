#pragma once
// The diagonal of the mass matrix of a tree, O(n): composite inertias from the leaves to the root.
// With twists of all bodies about the one point O they add without transport,
//   C_i = Mz_i + sum over the bodies c that hang from i of C_c
// A joint coordinate with the twist b moves its body and all that hangs from it: b^T C b. An
// amplitude k moves its own body by -Psi_k and the body c that hangs from it by Phi_ck - Psi_k.
#include <functional>

#include "floatframe/formulation/tree_kinematics.hpp"

namespace floatframe {

/// `inertia(i)`: (6+nm)^2 of body i over [sdot, omega, ydot], about O, world axes. At the last
/// `positions`. Allocates.
VecX composite_diagonal(const TreeKinematics& tree,
                        const std::function<const MatX&(int body)>& inertia);

}  // namespace floatframe
