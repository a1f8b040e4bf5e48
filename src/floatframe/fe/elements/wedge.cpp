// Wedges with 6 and 15 nodes. Triangle 1-3 below triangle 4-6, in the direction of its normal; then
// the middles of the edges 12 23 31 45 56 64 14 25 36. With the area coordinates
// L = (1 - xi_1 - xi_2, xi_1, xi_2) and t = xi_3, upper signs for the upper triangle:
//   6 nodes   N = L_i (1 +- t)/2
//   15 nodes  corners N = L_i (1 +- t)(2 L_i - 2 +- t)/2, edges of the triangles
//             2 L_i L_j (1 +- t), edges between them L_i (1 - t^2)
// K and M as in isoparametric.hpp. Stiffness with 3 x 2 and 3 x 3 points; CalculiX takes 1 x 2 for
// 6 nodes, which leaves a twist without energy. Mass exact, with curved edges too: N^T N det J has
// degree 3 in the triangle and 4 along the edges for 6 nodes, 8 and 9 for 15.
#include <cmath>

#include "floatframe/fe/isoparametric.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

const Vec3 dL[3] = {Vec3(-1, -1, 0), Vec3::UnitX(), Vec3::UnitY()};

void functions6(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  const double L[3] = {1.0 - xi(0) - xi(1), xi(0), xi(1)};
  for (int a = 0; a < 6; ++a) {
    const double side = a < 3 ? -1.0 : 1.0, f = 0.5 * (1.0 + side * xi(2));
    N(a) = L[a % 3] * f;
    dN.col(a) = dL[a % 3] * f + Vec3(0, 0, 0.5 * side * L[a % 3]);
  }
}

void functions15(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  const double L[3] = {1.0 - xi(0) - xi(1), xi(0), xi(1)}, t = xi(2);
  for (int a = 0; a < 6; ++a) {
    const int i = a % 3;
    const double side = a < 3 ? -1.0 : 1.0, f = 1.0 + side * t;
    // 1/2 L (1 +- t) (2 L - 2 +- t)
    const double g = 2.0 * L[i] - 2.0 + side * t;
    N(a) = 0.5 * L[i] * f * g;
    dN.col(a) = 0.5 * f * (g + 2.0 * L[i]) * dL[i] + Vec3(0, 0, 0.5 * side * L[i] * (g + f));
  }
  for (int e = 0; e < 6; ++e) {
    const int i = e % 3, j = (i + 1) % 3;
    const double side = e < 3 ? -1.0 : 1.0, f = 1.0 + side * t;
    N(6 + e) = 2.0 * L[i] * L[j] * f;
    dN.col(6 + e) = 2.0 * f * (L[i] * dL[j] + L[j] * dL[i]) + Vec3(0, 0, 2.0 * side * L[i] * L[j]);
  }
  for (int i = 0; i < 3; ++i) {
    N(12 + i) = L[i] * (1.0 - t * t);
    dN.col(12 + i) = (1.0 - t * t) * dL[i] + Vec3(0, 0, -2.0 * t * L[i]);
  }
}

/// Points of the triangle times 2 or 3 Gauss points.
QuadratureRule product(const QuadratureRule& triangle, int n) {
  const LineRule line = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int k = 0; k < n; ++k)
    for (const QuadraturePoint& q : triangle)
      rule.push_back({q.xi + Vec3(0, 0, 2 * line.u(k) - 1), 2 * q.weight * line.weight(k)});
  return rule;
}

QuadratureRule centre() { return {{Vec3(1.0 / 3.0, 1.0 / 3.0, 0), 0.5}}; }

/// 1, x, y times 1, t.
VecX smooth(const Vec3& xi) {
  const double x = xi(0) - 1.0 / 3.0, y = xi(1) - 1.0 / 3.0, t = xi(2);
  VecX f(6);
  f << 1, x, y, t, x * t, y * t;
  return f;
}

std::vector<Vec3> nodes(int count) {
  const Vec3 corner[3] = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  std::vector<Vec3> out;
  for (int a = 0; a < 6; ++a) out.push_back(corner[a % 3] + Vec3(0, 0, a < 3 ? -1 : 1));
  for (int e = 0; e < 6 && count == 15; ++e) {
    out.push_back(0.5 * (corner[e % 3] + corner[(e + 1) % 3]) + Vec3(0, 0, e < 3 ? -1 : 1));
  }
  for (int i = 0; i < 3 && count == 15; ++i) out.push_back(corner[i]);
  return out;
}

const solid::IsoparametricElement& wedge6() {
  static const solid::IsoparametricElement e =
      solid::isoparametric(6, &functions6, {product(triangle_rule_3(), 2), product(centre(), 2)},
                           {product(triangle_rule(2), 3), product(centre(), 2)},
                           {product(centre(), 2), nodes(6), &smooth});
  return e;
}
const solid::IsoparametricElement& wedge15() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      15, &functions15, {product(triangle_rule_3(), 3), product(triangle_rule_3(), 3)},
      {product(triangle_rule(5), 5), product(triangle_rule_3(), 3)},
      {product(triangle_rule_3(), 2), nodes(15), &smooth});
  return e;
}

}  // namespace

constinit const ElementKernel wedge6_kernel =
    solid::layered<wedge6>(solid::kernel<wedge6>(6, shape::wedge6));
constinit const ElementKernel wedge15_kernel =
    solid::layered<wedge15>(solid::kernel<wedge15>(15, shape::wedge15));

}  // namespace floatframe
