#pragma once
// Numbers of a file that are finite, but so large that results computed from them overflow.
#include <string>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// "its density is 1e+308, expected a number whose square does not overflow"; empty if modulus,
/// elasticity and density are smaller.
std::string huge_constant(const Material& material);
/// The same of thickness and offset of a section of shells and of the mass over area, with that of
/// its plies or of `density`.
std::string huge_sheet(const ShellSection& shell, double density,
                       const std::vector<Material>& materials);
/// The same of a point mass.
std::string huge_mass(double mass, const Mat3& J);
/// The same of a place, whose cubes are volumes.
std::string huge_place(const Vec3& p);

}  // namespace floatframe
