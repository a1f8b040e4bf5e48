#pragma once
// The six conditions of a body reference (BodyReference) on the modes and on the degrees of freedom
// of a part.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

/// 6 x modes; `raw`: the integrals of the basis.
MatX reference_conditions(const FeModel& model, const ModeBasis& basis,
                          const InertiaInvariants& raw,
                          const std::vector<InterfacePlace>& interfaces,
                          const PartOptions& options);

/// The same conditions on all dofs, 6 x n; `loads`: of the masses (body_loads).
MatX reference_rows(const FeModel& model, const MatX& loads,
                    const std::vector<InterfacePlace>& interfaces, const PartOptions& options);

}  // namespace floatframe
