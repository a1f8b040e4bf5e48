// Pyramids with 5 and 13 nodes. Base 1-4, anticlockwise seen from the apex 5, then the middles of
// the edges 12 23 34 41 15 25 35 45. The parent domain is a brick, xi_1 and xi_2 from -1 to 1, t =
// xi_3 from 0 to 1, that collapses towards the apex: the coordinates of the regular pyramid are
// xi_1 (1 - t), xi_2 (1 - t), t. With w = 1 - t, x = xi_1, y = xi_2, signs s_x, s_y of a corner:
//   5 nodes   base w (1 + s_x x)(1 + s_y y)/4, apex t
//   13 nodes  base w (1 + s_x x)(1 + s_y y)(w (s_x x + s_y y) - 1)/4, apex t (2 t - 1), edges of
//             the base w^2 (1 - x^2)(1 + s_y y)/2 and w^2 (1 + s_x x)(1 - y^2)/2, edges to the apex
//             t w (1 + s_x x)(1 + s_y y)
// These are the rational functions of Bedrosian (1992), which meet those of tetrahedra, bricks and
// wedges on common faces. K and M as in isoparametric.hpp. Stiffness with 2 x 2 x 2 and 3 x 3 x 3
// points, exact for straight pyramids over a parallelogram; mass exact, with curved edges too: N^T
// N det J has degree 3, 3, 4 for 5 nodes and 9, 9, 9 for 13.
#include "floatframe/fe/isoparametric.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

constexpr double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};

/// w f(x) g(y) and so on: a product of three functions of one variable each.
struct Product {
  double fx, dx, fy, dy, ft, dt;
  double value() const { return fx * fy * ft; }
  Vec3 gradient() const { return {dx * fy * ft, fx * dy * ft, fx * fy * dt}; }
};

void functions5(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  const double w = 1.0 - xi(2);
  for (int a = 0; a < 4; ++a) {
    const Product p{
        0.5 * (1 + sx[a] * xi(0)), 0.5 * sx[a], 0.5 * (1 + sy[a] * xi(1)), 0.5 * sy[a], w, -1.0};
    N(a) = p.value();
    dN.col(a) = p.gradient();
  }
  N(4) = xi(2);
  dN.col(4) = Vec3::UnitZ();
}

void functions13(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  const double x = xi(0), y = xi(1), t = xi(2), w = 1.0 - t;
  const auto set = [&](int a, const Product& p) {
    N(a) = p.value();
    dN.col(a) = p.gradient();
  };
  for (int a = 0; a < 4; ++a) {
    const Product p{0.5 * (1 + sx[a] * x), 0.5 * sx[a], 0.5 * (1 + sy[a] * y),
                    0.5 * sy[a],           w,           -1.0};
    const double s = sx[a] * x + sy[a] * y, g = w * s - 1;
    N(a) = p.value() * g;
    dN.col(a) = p.gradient() * g + p.value() * Vec3(w * sx[a], w * sy[a], -s);
    set(9 + a, {1 + sx[a] * x, sx[a], 1 + sy[a] * y, sy[a], t * w, 1 - 2 * t});
  }
  N(4) = t * (2 * t - 1);
  dN.col(4) = Vec3(0, 0, 4 * t - 1);
  for (const int e : {0, 2})  // 12 and 34, along x
    set(5 + e, {1 - x * x, -2 * x, 0.5 * (1 + sy[e] * y), 0.5 * sy[e], w * w, -2 * w});
  for (const int e : {1, 3})  // 23 and 41, along y
    set(5 + e, {0.5 * (1 + sx[e] * x), 0.5 * sx[e], 1 - y * y, -2 * y, w * w, -2 * w});
}

/// n^3 points of the collapsed brick.
QuadratureRule collapsed(int n) {
  const LineRule line = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        rule.push_back({Vec3(2 * line.u(i) - 1, 2 * line.u(j) - 1, line.u(k)),
                        4 * line.weight(i) * line.weight(j) * line.weight(k)});
  return rule;
}

/// 1, x, y, t of the regular pyramid.
VecX smooth(const Vec3& xi) {
  const double w = 1.0 - xi(2);
  VecX f(4);
  f << 1, xi(0) * w, xi(1) * w, xi(2) - 0.25;
  return f;
}

std::vector<Vec3> nodes(int count) {
  std::vector<Vec3> at;
  for (int a = 0; a < 4; ++a) at.emplace_back(sx[a], sy[a], 0);
  at.emplace_back(0, 0, 1);
  for (int a = 0; a < 4; ++a) at.push_back(0.5 * (at[a] + at[(a + 1) % 4]));
  for (int a = 0; a < 4; ++a) at.emplace_back(sx[a], sy[a], 0.5);
  at.resize(count);
  return at;
}

/// Points where the Jacobian must be positive: the corners of the base and near the apex.
QuadratureRule corners() {
  QuadratureRule rule;
  for (const double t : {0.0, 0.9})
    for (int a = 0; a < 4; ++a) rule.push_back({Vec3(sx[a], sy[a], t), 0.0});
  return rule;
}

const solid::IsoparametricElement& pyramid5() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      5, &functions5, {collapsed(2), collapsed(2)}, {collapsed(3), collapsed(3)},
      {collapsed(2), nodes(5), &smooth}, corners());
  return e;
}

const solid::IsoparametricElement& pyramid13() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      13, &functions13, {collapsed(3), collapsed(3)}, {collapsed(5), collapsed(5)},
      {collapsed(2), nodes(13), &smooth}, corners());
  return e;
}

}  // namespace

constinit const ElementKernel pyramid5_kernel = solid::kernel<pyramid5>(5, shape::pyramid5);
constinit const ElementKernel pyramid13_kernel = solid::kernel<pyramid13>(13, shape::pyramid13);

}  // namespace floatframe
