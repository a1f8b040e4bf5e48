#pragma once
// Flat thin shell triangle, 18 dofs: membrane with drilling rotations, Kirchhoff plate. Building
// block of tri3 and quad4.
#include <array>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

using Mat18 = Eigen::Matrix<double, 18, 18>;

/// Columns: x along the side 1-2, y in the plane, z the normal.
Mat3 triangle_axes(const std::array<Vec3, 3>& p);
double triangle_area(const std::array<Vec3, 3>& p);

/// In body axes, (ux uy uz rx ry rz) per node.
Mat18 shell_triangle_stiffness(const std::array<Vec3, 3>& p, const Material& material,
                               double thickness);
/// Mean membrane forces per length (xx, yy, xy) in the axes of the triangle from the displacements
/// of the corners in body axes.
Eigen::Matrix<double, 3, 18> shell_triangle_membrane(const std::array<Vec3, 3>& p,
                                                     const Material& material, double thickness);
Mat18 shell_triangle_mass(const std::array<Vec3, 3>& p, const Material& material, double thickness,
                          bool section_inertia);

}  // namespace floatframe
