#pragma once
// Flexibility of the reduced body between its interfaces, against the full model: one interface is
// held, the others are loaded with six unit loads each, one after the other.
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/reduction/mode_basis.hpp"

namespace floatframe {

/// Response of the full model at all boundary rows: Guyan stiffness, or displacements under unit
/// forces with inertia relief.
struct Statics {
  MatX stiffness, flexibility;
};
/// `structure`: given if the part is free.
Statics statics_of(const ModeBasis& basis, const std::optional<FreeStructure>& structure,
                   const Eigenpairs& elastic, const std::vector<InterfacePlace>& interfaces, int n);

/// Fills `static_error` and `static_support`. `nodes` of the body: the interfaces come first.
/// boundary_stiffness: Guyan stiffness of all boundary rows (Craig-Bampton), or empty; then
/// boundary_flexibility: their displacements under unit forces with inertia relief.
void check_statics(const std::vector<InterfacePlace>& interfaces, const FlexibleBody& body,
                   const MatX& boundary_stiffness, const MatX& boundary_flexibility,
                   HealthReport& health);

}  // namespace floatframe
