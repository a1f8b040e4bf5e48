#pragma once
// Stiffness and mass in all dofs of the table, before any is eliminated.
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

SparseMatrix full_stiffness(const FeModel& model, const DofTable& table, Integration integration);
/// Consistent; beams with rotary and torsional inertia of the section.
SparseMatrix full_mass(const FeModel& model, const DofTable& table, Integration integration);
/// Without the elements that are sums of stations.
SparseMatrix mass_without_stations(const FeModel& model, const DofTable& table,
                                   Integration integration);
/// Is the element a sum of stations (ElementKernel::mass_stations)?
bool has_mass_stations(const FeElement& element) noexcept;

}  // namespace floatframe
