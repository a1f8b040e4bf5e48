// 10-node tetrahedron. Corners as tet4, then the middles of the edges 12 23 13 14 24 34. With the
// volume coordinates L = (1 - sum xi, xi_1, xi_2, xi_3):
//   corners N = L_i (2 L_i - 1),  middles N = 4 L_i L_j;  K and M as in isoparametric.hpp
// Stiffness with 4 points (exact with straight edges); mass with 64 points, exact with curved edges
// as well: N^T N det J has degree 4 + 3.
#include "floatframe/fe/isoparametric.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

constexpr int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

void functions(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  const double L[4] = {1.0 - xi.sum(), xi(0), xi(1), xi(2)};
  const Vec3 dL[4] = {Vec3(-1, -1, -1), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int a = 0; a < 4; ++a) {
    N(a) = L[a] * (2.0 * L[a] - 1.0);
    dN.col(a) = (4.0 * L[a] - 1.0) * dL[a];
  }
  for (int e = 0; e < 6; ++e) {
    const int i = edge[e][0], j = edge[e][1];
    N(4 + e) = 4.0 * L[i] * L[j];
    dN.col(4 + e) = 4.0 * (L[i] * dL[j] + L[j] * dL[i]);
  }
}

/// 1, x, y, z about the centre.
VecX smooth(const Vec3& xi) {
  VecX f(4);
  f << 1.0, xi - Vec3::Constant(0.25);
  return f;
}

std::vector<Vec3> nodes() {
  const Vec3 corner[4] = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  std::vector<Vec3> out(corner, corner + 4);
  for (const auto& e : edge) out.push_back(0.5 * (corner[e[0]] + corner[e[1]]));
  return out;
}

const solid::IsoparametricElement& element() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      10, &functions, {tetrahedron_rule_4(), tetrahedron_rule_4()},
      {tetrahedron_rule(4), tetrahedron_rule_4()}, {tetrahedron_rule_4(), nodes(), &smooth});
  return e;
}

}  // namespace

constinit const ElementKernel tet10_kernel = solid::kernel<element>(10, shape::tet10);

}  // namespace floatframe
