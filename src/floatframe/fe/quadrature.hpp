#pragma once
// Numerical integration over the parent domains of the solid elements. Product rules of Gauss
// points, collapsed (Gauss-Jacobi) towards a corner of triangles and tetrahedra: n points per
// direction integrate every polynomial of degree 2n - 1 exactly, with positive weights.
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct QuadraturePoint {
  Vec3 xi = Vec3::Zero();
  double weight = 0.0;
};
using QuadratureRule = std::vector<QuadraturePoint>;

/// Points on [0, 1] for int (1 - u)^alpha f(u) du, n points; alpha = 0: Gauss-Legendre.
struct LineRule {
  VecX u, weight;
};
LineRule gauss_jacobi(int n, int alpha);

/// [-1, 1]^3, n^3 points, xi_1 fastest.
QuadratureRule brick_rule(int n);
/// Tetrahedron 0 <= xi, sum xi <= 1 (volume 1/6), n^3 points.
QuadratureRule tetrahedron_rule(int n);
/// The same with the 4 symmetric points, degree 2.
QuadratureRule tetrahedron_rule_4();
/// Triangle 0 <= xi_1, xi_2, xi_1 + xi_2 <= 1, xi_3 = 0, n^2 points; weights sum to 1/2.
QuadratureRule triangle_rule(int n);
/// The same with the 3 symmetric points, degree 2.
QuadratureRule triangle_rule_3();

}  // namespace floatframe
