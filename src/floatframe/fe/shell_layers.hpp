#pragma once
// The section of a shell, by classical laminate theory. About the middle of the thickness t, with
// strains e = (xx, yy, 2 xy) there and curvatures k, e(z) = e + z k, z along the normal:
//   N = A e + B k,  M = B e + D k;   A, B, D = sum over the plies of int Q (1, z, z^2) dz
// Q: plane stress of the ply in the axes of the element (fe/elasticity.hpp). Smeared plies: B = 0,
// D = A t^2/12. Without plies, with separate materials for membrane, bending and coupling:
//   A = t Q_m, B = -t^2 Q_c, D = f t^3/12 Q_b, stress Q_m e + z Q_b k
// Transverse shear: the mean of G_13 and G_23 over the thickness in the axes of the element, times
// ShellSection::shear; none (thin) if a ply has no such modulus.
// (the sign of B is that of Nastran's MID4, whose curvatures have the opposite sign). Axis 1 of the
// element is a direction in the body, projected on the shell; ply angles are measured from it.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct ShellLayers {
  Mat3 A = Mat3::Zero(), B = Mat3::Zero(), D = Mat3::Zero();
  /// Mass over area, its first and second moment about the middle.
  double mass = 0.0, moment = 0.0, inertia = 0.0;
  double offset = 0.0;  ///< of the middle from the nodes, along the normal
  /// Transverse shear forces over a width (xz, yz) from the shear strains; zero: thin.
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();
  /// Stress of a side: membrane e + bending k.
  struct Side {
    Mat3 membrane = Mat3::Zero(), bending = Mat3::Zero();
  };
  Side top, bottom;
  /// Weight of the higher-order membrane strains (fe/shell_triangle.cpp): (1 - 4 nu_12 nu_21)/2 of
  /// the membrane stiffness, at least 0.01.
  double beta_0 = 0.0;
  unsigned own_drilling = 0;  ///< of a triangle, bit k: constant stress has no moment at corner k
  bool directional = true;    ///< false: isotropic in its plane, for any axis
  Vec3 axis = Vec3::UnitX();  ///< axis 1 in the body
};

/// One isotropic material only.
bool is_plain(const ShellSection& section, const Material& material);
ShellLayers plain_layers(const ShellSection& section, const Material& material);
/// In the axes of the element.
ShellLayers shell_layers(const ShellSection& section, const Material& material,
                         const std::vector<Material>& materials);
/// In axes relative to which those of `layers` are rotated by an angle about the normal.
ShellLayers turned_layers(const ShellLayers& layers, double angle);

/// Error in a section other than in its thickness; empty if there is none.
std::string section_error(const ShellSection& section, const std::vector<Material>& materials);

/// Normal of a shell with 3 or 4 corners first among its nodes.
Vec3 shell_normal(std::span<const Vec3> corners);
/// Axis 1 of a shell: the first axis of an orientation at its middle, or the side 1-2, projected on
/// the shell and rotated about the normal. Zero if the axis has no projection.
Vec3 first_axis(std::span<const Vec3> corners, const Orientation* orientation, double angle);

}  // namespace floatframe
