// 20-node serendipity brick. Corners as hex8, then the middles of the edges 12 23 34 41 56 67 78 85
// 15 26 37 48. With the local coordinates c of node a, 0 along the edge of a middle node:
//   corners  N = 1/8 prod_i (1 + c_i xi_i) (c.xi - 2)
//   middles  N = 1/4 (1 - xi_k^2) prod_(i not k) (1 + c_i xi_i), k along the edge
// K and M as in isoparametric.hpp. Stiffness with 3 x 3 x 3 points, reduced: 2 x 2 x 2 (no
// hourglass modes that survive in a mesh of several elements). Mass with 5 x 5 x 5 points: exact
// with curved edges.
#include "floatframe/fe/isoparametric.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

constexpr double at[20][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1},
                              {1, -1, 1},   {1, 1, 1},   {-1, 1, 1}, {0, -1, -1}, {1, 0, -1},
                              {0, 1, -1},   {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},   {0, 1, 1},
                              {-1, 0, 1},   {-1, -1, 0}, {1, -1, 0}, {1, 1, 0},   {-1, 1, 0}};

void functions(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  for (int a = 0; a < 20; ++a) {
    // Products of 1 + c x along the directions of the corner, 1 - x^2 along the edge.
    Vec3 f, df;
    double sum = -2.0;
    for (int i = 0; i < 3; ++i) {
      const double c = at[a][i], x = xi(i);
      f(i) = c == 0.0 ? 1.0 - x * x : 1.0 + c * x;
      df(i) = c == 0.0 ? -2.0 * x : c;
      sum += c * x;
    }
    const double product = f(0) * f(1) * f(2);
    const Vec3 gradient(df(0) * f(1) * f(2), f(0) * df(1) * f(2), f(0) * f(1) * df(2));
    if (a >= 8) {
      N(a) = 0.25 * product;
      dN.col(a) = 0.25 * gradient;
    } else {
      N(a) = 0.125 * product * sum;
      dN.col(a) = 0.125 * (gradient * sum + product * Vec3(at[a][0], at[a][1], at[a][2]));
    }
  }
}

std::vector<Vec3> nodes() {
  std::vector<Vec3> out;
  for (const auto& x : at) out.emplace_back(x[0], x[1], x[2]);
  return out;
}

const solid::IsoparametricElement& full() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      20, &functions, {brick_rule(3), brick_rule(3)}, {brick_rule(5), brick_rule(3)},
      {brick_rule(2), nodes(), &solid::trilinear});
  return e;
}
const solid::IsoparametricElement& reduced() {
  static const solid::IsoparametricElement e = solid::isoparametric(
      20, &functions, {brick_rule(2), brick_rule(2)}, {brick_rule(5), brick_rule(2)},
      {brick_rule(2), nodes(), &solid::trilinear});
  return e;
}

}  // namespace

constinit const ElementKernel hex20_kernel =
    solid::layered<full>(solid::kernel<full>(20, shape::hex20));
constinit const ElementKernel hex20r_kernel =
    solid::layered<reduced>(solid::kernel<reduced>(20, shape::hex20));

}  // namespace floatframe
