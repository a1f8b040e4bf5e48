#pragma once
// Flat shell triangle, 18 dofs: membrane with drilling rotations, plate with transverse shear if
// the section has it, else of Kirchhoff. Building block of all shells.
#include <array>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

using Mat18 = Eigen::Matrix<double, 18, 18>;

/// Columns: x along the side 1-2, y in the plane, z the normal.
Mat3 triangle_axes(const std::array<Vec3, 3>& p);
double triangle_area(const std::array<Vec3, 3>& p);
/// Plane stress (xx, yy, xy) in the axes R of a triangle as (xx, yy, zz, xy, yz, zx) in body axes.
Eigen::Matrix<double, 6, 3> from_triangle_axes(const Mat3& R);

/// A section in the axes of a triangle.
struct TriangleSection {
  Mat3 R;  ///< triangle_axes
  ShellLayers layers;
  TriangleSection(const std::array<Vec3, 3>& p, const ShellLayers& section);
};

/// In body axes, (ux uy uz rx ry rz) per node.
Mat18 shell_triangle_stiffness(const std::array<Vec3, 3>& p, const ShellLayers& section);
/// Mean membrane forces per length (xx, yy, xy) in the axes of the triangle from the displacements
/// of the corners in body axes.
Eigen::Matrix<double, 3, 18> shell_triangle_membrane(const std::array<Vec3, 3>& p,
                                                     const ShellLayers& section);
/// Stresses in body axes at a corner, on the side of the normal and on the other one.
Eigen::Matrix<double, 12, 18> shell_triangle_stress(const std::array<Vec3, 3>& p,
                                                    const ShellLayers& section, int corner);
Mat18 shell_triangle_mass(const std::array<Vec3, 3>& p, const ShellLayers& section,
                          bool section_inertia);
/// Displacements of the middle of the thickness at the nodes from those of the nodes.
Mat18 to_middle(const Vec3& normal, double offset);

}  // namespace floatframe
