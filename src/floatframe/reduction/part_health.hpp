#pragma once
// The figures of the health report from the full model, and its suspicious properties.
#include "floatframe/reduction/mode_basis.hpp"

namespace floatframe {

/// Mass properties from the assembled mass and the rigid motions about the origin.
MassProperties mass_properties(const SparseMatrix& M, const MatX& R);
MassProperties mass_properties(const InertiaInvariants& invariants);

/// Throws InputError with the missing property of a part that cannot vibrate.
void require_mass_and_elasticity(const FeModel& model, const FeSystem& system,
                                 const MassProperties& properties);
/// Throws InputError for collinear masses or a single point mass, which rotate without inertia:
/// frames of mean axes and free modes cannot distinguish that from an elastic motion.
void require_inertia(const FeModel& model, const FeSystem& system, const PartOptions& options,
                     const MassProperties& properties);

/// One sentence for each suspicious figure of those collected so far.
void add_warnings(const FeModel& model, const PointModel& points, HealthReport& health);

/// "the file may be in mm-t-s and not in m-kg-s: then ..."; empty if the numbers are usual, or
/// unusual in all unit systems.
std::string unit_guess(const FeModel& model, double mass);

}  // namespace floatframe
