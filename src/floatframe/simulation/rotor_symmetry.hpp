#pragma once
// Whether a rotor is symmetric about its axis, and what makes it unsymmetric.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/simulation/rotor.hpp"

namespace floatframe {

/// Change of eigenvalues with the angle that is still called symmetric: meshes are not quite round.
inline constexpr double symmetric_enough = 5e-3;

/// Throws RunError with its reasons if eigenvalues change by more with the angle.
void require_symmetry(const Model& model, const Rotor& rotor, double dependence);

/// What makes the rotor unsymmetric, a phrase each: masses off the axis, moments of inertia that
/// differ, numbers of modes that cut a pair.
std::vector<std::string> asymmetries(const Model& model, const Rotor& rotor);

/// Of a free joint without a given axis: the one of `axes` (world) along the bearings that hold
/// `bodies`, else the one about which they are symmetric. Throws InputError if there is not one.
int fitting_axis(const Model& model, const std::string& joint, const std::vector<int>& bodies,
                 const Mat3& axes);

/// "; the bearings of the rotor have the axis x of the joint" if they have one, and it is not
/// `axis`; else nothing. World axes.
std::string other_axis_of_bearings(const Model& model, const std::vector<int>& bodies,
                                   const Mat3& axes, const Vec3& axis);

}  // namespace floatframe
