#pragma once
// Common parts of the solid elements: strain-displacement matrix, gradients of displacements.
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe::solid {

using Gradients = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 20>;  ///< column a: dN_a/dx
using Strain = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 60>;

/// Strains (xx, yy, zz, xy, yz, zx), engineering shear.
inline Strain strain_matrix(const Gradients& g) {
  Strain B = Strain::Zero(6, 3 * g.cols());
  for (int a = 0; a < g.cols(); ++a) {
    const double x = g(0, a), y = g(1, a), z = g(2, a);
    B.block<6, 3>(0, 3 * a) << x, 0, 0, 0, y, 0, 0, 0, z, y, x, 0, 0, z, y, z, 0, x;
  }
  return B;
}

/// A point with the gradients g of the shape functions, for the displacements of the nodes.
inline void set_gradient(const Gradients& g, MatX& out) {
  out = MatX::Zero(9, 3 * g.cols());
  for (int a = 0; a < g.cols(); ++a)
    for (int i = 0; i < 3; ++i) out.block<3, 1>(3 * i, 3 * a + i) = g.col(a);
}

}  // namespace floatframe::solid
