#pragma once
// Damping of a part: that of a damping matrix C given with stiffness and mass, and that of
// fractions of its modes (body/modal_damping.hpp); together D.
//
// C may resist rigid motions (alpha M of Rayleigh, dampers to the ground). Only its effect on
// deformations counts, those of the free part about its mean axes, for any body frame:
//   D_C = X_e^T C X_e,   X_e = X - R M_rr^+ M_rf
#include "floatframe/reduction/mode_basis.hpp"

namespace floatframe {

/// The degrees of freedom of the interfaces; the nodes of the body begin with theirs.
std::vector<InterfaceDofs> mounted_at(const std::vector<InterfacePlace>& interfaces);

/// D of the body and its part of the report. X: its modes. InputError if a matrix adds energy.
void add_damping(const PlacedPart& part, const MatX& X, FlexibleBody& body, HealthReport& health);

}  // namespace floatframe
