#pragma once
// Conditions on a free part: six rigid motions without force, and no seventh motion without
// stiffness. All measures are relative to the part: rotations count times its size, so that a model
// in other units or of another scale gives the same numbers.
//
// Load time: throws InputError with the nodes.
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Half the diagonal of the box around the nodes in use [m].
double part_size(const FeModel& model, const FeSystem& system);

/// For each row of the system: 1 for translations, `size` for rotations.
VecX row_lengths(const FeSystem& system, double size);

/// Largest |K R| / |K|, R the rigid motions. Throws if it is above `largest_rigid_residual`: the
/// part has a support.
double check_rigid_motions(const FeModel& model, const FeSystem& system);
inline constexpr double largest_rigid_residual = 1e-3;

/// Cause of the stiffness of a rigid motion, in spite of its small `residual`: a soft spring that
/// does not act along the line of its nodes, else a support or the digits of the stiffness.
std::string stiffness_cause_text(const FeModel& model, double residual);

/// Throws if a shape (n x k, the rigid motions are not among them) has no stiffness: its strain
/// energy cannot be distinguished from the rounding of the entries of K,
///   x^T K x <= least |x|^T |K| |x|
void check_stiffness_of(const FeModel& model, const FeSystem& system, const MatX& shapes);
inline constexpr double least_strain_energy = 1e-13;

/// The sentence about a mechanism that moves as `shape`.
std::string mechanism_text(const FeModel& model, const FeSystem& system, const VecX& shape);

}  // namespace floatframe
