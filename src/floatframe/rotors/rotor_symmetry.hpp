#pragma once
// Checks whether a rotor is symmetric about its axis, and finds the causes of asymmetry.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/rotors/rotor.hpp"

namespace floatframe {

/// Change of eigenvalues with the angle that still counts as symmetric: meshes are not quite round.
inline constexpr double symmetric_enough = 5e-3;

/// Throws RunError with the causes if eigenvalues change by more with the angle.
void require_symmetry(const Model& model, const Rotor& rotor, double dependence);

/// The causes of asymmetry, one phrase each: masses off the axis, different moments of inertia,
/// numbers of modes that separate a pair.
std::vector<std::string> asymmetries(const Model& model, const Rotor& rotor);

/// For a free joint without a given axis: the one of `axes` (world) along the bearings that hold
/// `bodies`, else the one of their symmetry. Throws InputError unless there is exactly one.
int fitting_axis(const Model& model, const std::string& joint, const std::vector<int>& bodies,
                 const Mat3& axes);

/// "; the bearings of the rotor have the axis x of the joint" if they have one, and it is not
/// `axis`; else nothing. World axes.
std::string other_axis_of_bearings(const Model& model, const std::vector<int>& bodies,
                                   const Mat3& axes, const Vec3& axis);

}  // namespace floatframe
