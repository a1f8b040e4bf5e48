#pragma once
// Elasticity matrices, sigma = D epsilon with (xx, yy, zz, xy, yz, zx) and engineering shear. In
// axes R (columns: the axes of the material) sigma_body = T sigma, epsilon = T^T epsilon_body, so
//   D_body = T D T^T,   T(ij, ab) = R_ia R_jb (+ R_ib R_ja of a shear)
// From engineering constants the compliance is
//   S_11 = 1/E_1, S_12 = -nu_12/E_1, ..., S_44 = 1/G_12;   nu_ij = -epsilon_j/epsilon_i under
//   stress along i, so nu_ji = nu_ij E_j/E_i
// Plane stress leaves the rows and columns xx, yy, xy of the compliance, inverted.
#include <functional>
#include <string>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// In the axes of the material.
Mat6 elasticity_matrix(const Material& material);

/// In body axes; columns of R: the axes of the material.
Mat6 turned_elasticity(const Mat6& D, const Mat3& R);

/// (xx, yy, xy) of plane stress in the axes of the material.
Mat3 plane_stress(const Material& material);
/// The same in axes relative to which those of the material are rotated about the normal.
Mat3 turned_plane(const Mat3& Q, double angle);

struct EngineeringConstants {
  double E1 = 0.0, E2 = 0.0, E3 = 0.0;
  double nu12 = 0.0, nu13 = 0.0, nu23 = 0.0;
  double G12 = 0.0, G13 = 0.0, G23 = 0.0;
};
Mat6 elasticity_of(const EngineeringConstants& c);
/// Error in the constants ("NU12 is 3, expected ..."); empty if they give a positive definite
/// matrix. For a lamina only the in-plane ones count, and transverse shear may be 0.
std::string engineering_error(const EngineeringConstants& c, bool lamina);

/// In the plane of a layer: E1, E2, nu12, G12, and the transverse shear moduli G13 and G23.
Mat6 lamina_elasticity(const EngineeringConstants& c);
/// For a layer: plane-stress matrix Q (xx, yy, xy) and the transverse shear moduli.
Mat6 layer_elasticity(const Mat3& Q, double G13, double G23);

/// Reason why a matrix is not positive definite, with the name of the constant at (i, j); empty if
/// it is. `plane`: of xx, yy, xy only.
std::string elasticity_error(const Mat6& D, bool plane,
                             const std::function<std::string(int i, int j)>& name);

/// "D(xx, yz)"
std::string elasticity_name(int i, int j);

/// A material with a matrix; Young's modulus and Poisson's ratio for display follow from it.
Material anisotropic_material(const Mat6& D, bool plane, double density);

}  // namespace floatframe
