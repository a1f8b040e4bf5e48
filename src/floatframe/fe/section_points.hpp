#pragma once
// Stress points of a beam's section: the points of its outline where bending,
// torsion and shear are largest. Local axes of the beam, section forces (N, Vy, Vz, T, My, Mz) of
// the face whose normal is x:
//   sigma_xx = N/A + My z/Iy - Mz y/Iz
//   round      8 points; tau = T r/J along the circle, and of shear k V/A along it at the neutral
//              axis, k = 4/3 (Ro^2 + Ro Ri + Ri^2) / (Ro^2 + Ri^2)
//   rectangle  corners, where torsion and shear vanish, and middles of the sides, where
//              shear gives 3/2 V/A and torsion the slopes of Prandtl's stress function
//              (Timoshenko, Goodier, Theory of Elasticity (1951), section 94)
// Shear stress is given for solid sections and round tubes.
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct SectionPoint {
  double y = 0.0, z = 0.0;  ///< [m]
  /// sigma_xx, tau_xy, tau_xz from the section forces.
  Eigen::Matrix<double, 3, 6> S = Eigen::Matrix<double, 3, 6>::Zero();
};

/// Empty if the outline is unknown.
std::vector<SectionPoint> section_points(const BeamSection& section);

}  // namespace floatframe
