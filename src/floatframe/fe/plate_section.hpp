#pragma once
// Sections of beams composed of rectangles ("plates") with sides along y and z, which touch and do
// not overlap: I, L, T, channels, boxes, hats.
#include <Eigen/Core>
#include <span>

namespace floatframe {

struct SectionPlate {
  double y = 0.0, z = 0.0;           ///< centre [m]
  double height = 0.0, width = 0.0;  ///< along y, along z [m]
};

/// Sums over the plates, exact except for J:
///   A = sum b h,  Iz = sum (b h^3/12 + b h y^2),  Iy = sum (h b^3/12 + b h z^2),
///   Iyz = sum b h y z with y, z of the plates' centres from the centroid
struct PlateSums {
  double A = 0.0;                        ///< [m2]
  double y = 0.0, z = 0.0;               ///< centroid [m]
  double Iz = 0.0, Iy = 0.0, Iyz = 0.0;  ///< int y^2, z^2, y z dA about it [m4]
  double thin_J = 0.0;                   ///< sum of b t^3/3: of open sections of thin plates [m4]
};
PlateSums plate_sums(std::span<const SectionPlate> plates);

/// Torsion constant of a box of thin walls (Bredt), 4 A_m^2 / sum b/t: width w and height h
/// outside, walls above, below, left and right.
double bredt_torsion(double w, double h, double top, double bottom, double left, double right);

/// Torsion and shear of the solid section (Saint-Venant, without Poisson's ratio).
struct SectionFlow {
  double J = 0.0;         ///< torsion constant [m4]
  double center_y = 0.0;  ///< shear centre, in the coordinates of the plates [m]
  double center_z = 0.0;  ///< [m]
  /// F: the energy of shear forces V = (Vy, Vz) on a length is V^T F V / (2 G) [1/m2].
  Eigen::Matrix2d shear_flexibility = Eigen::Matrix2d::Zero();
  bool found = false;  ///< false: no connected section with sides of like size
};

/// By finite elements of second order on the plates: with the warping function w of torsion and the
/// potential f of the shear stress of a shear force, tau = grad f,
///   div grad w = 0,     tau_xy = w,y - z, tau_xz = w,z + y,   J = Iy + Iz - int |grad w|^2
///   div grad f = -(linear normal stress of the force),        F = int |grad f|^2
SectionFlow section_flow(std::span<const SectionPlate> plates);

}  // namespace floatframe
