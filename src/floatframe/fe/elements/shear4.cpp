// 4-node shear panel of Garvey: its edges transmit shear only. In the plane of its diagonals the
// stress is pure shear on two families of lines, those through the point P where the sides 14 and
// 23 meet and those through Q, where 12 and 43 meet. With w the distance from the line PQ and theta
// the angle between the two lines at a place, the shear flow and its energy are
//   q = q_12 w_1 w_2/w^2,   E = int q^2/(2 G t) (1 + 2 cot^2 theta/(1 + nu)) dA
// q_12: mean of the side 12. Half of the force of a side goes to each of its ends, where the two
// sides together pull along the diagonal:
//   f_1 = -f_3 = q_12 a_1 d_13,  a_1 = L_12/2 (e_12 x e_14)/(d_13 x e_14),   f_2 = -f_4 likewise.
// So K = a a^T/(2E) at q_12 = 1. P and Q may be at infinity: their coordinates are homogeneous.
// Source: Garvey, The quadrilateral shear panel (Aircraft Engineering 1951).
#include <algorithm>
#include <array>
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"

namespace floatframe {
namespace {

constexpr int points_per_side = 12;

/// The corners in the plane of the diagonals, in units of their size about their middle.
struct Plane {
  Vec3 d13 = Vec3::Zero(), d24 = Vec3::Zero();  ///< unit vectors along the diagonals
  std::array<Vec3, 4> x;                        ///< homogeneous
  double size = 0.0;
};

Plane plane_of(const ElementInput& in) {
  Plane out;
  const Vec3 d13 = in.p[2] - in.p[0], d24 = in.p[3] - in.p[1];
  out.size = std::max(d13.norm(), d24.norm());
  out.d13 = d13.normalized();
  out.d24 = d24.normalized();
  const Vec3 n = d13.cross(d24).normalized(), e = out.d13, f = n.cross(e);
  const Vec3 middle = 0.25 * (in.p[0] + in.p[1] + in.p[2] + in.p[3]);
  for (int i = 0; i < 4; ++i) {
    const Vec3 r = (in.p[i] - middle) / out.size;
    out.x[i] = {r.dot(e), r.dot(f), 1.0};
  }
  return out;
}

/// Twice the area of a triangle of homogeneous points.
double twice(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

double thickness(const ElementInput& in) {
  return in.shell.shear > 0.0 ? in.shell.shear : in.shell.thickness;
}

std::string error(const ElementInput& in) {
  if (!(in.shell.thickness > 0.0) || !std::isfinite(in.shell.thickness))
    return "has a thickness that is not positive";
  if (!(in.shell.shear >= 0.0) || !std::isfinite(in.shell.shear))
    return "has a shear stiffness that is negative or no number";
  const Plane p = plane_of(in);
  for (int i = 0; i < 4; ++i)
    if (!(twice(p.x[i], p.x[(i + 1) % 4], p.x[(i + 2) % 4]) > 1e-6))
      return "is not convex, or its corners are in the wrong order";
  return {};
}

/// 2 E at q_12 = 1.
double flexibility(const ElementInput& in, const Plane& p) {
  const auto& x = p.x;
  const Vec3 P = x[0].cross(x[3]).cross(x[1].cross(x[2])),
             Q = x[0].cross(x[1]).cross(x[3].cross(x[2])), line = P.cross(Q);
  const double w12 = line.dot(x[0]) * line.dot(x[1]), nu = in.material.poisson;
  const LineRule rule = gauss_jacobi(points_per_side, 0);
  double sum = 0.0;
  for (int i = 0; i < points_per_side; ++i)
    for (int j = 0; j < points_per_side; ++j) {
      const double u = rule.u(i), v = rule.u(j);
      const Vec3 at =
          (1 - u) * (1 - v) * x[0] + u * (1 - v) * x[1] + u * v * x[2] + (1 - u) * v * x[3];
      const Vec3 du = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]),
                 dv = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
      const double area = du(0) * dv(1) - du(1) * dv(0), w = line.dot(at);
      const Vec3 to_P = P - P(2) * at, to_Q = Q - Q(2) * at;
      const double cross = to_P(0) * to_Q(1) - to_P(1) * to_Q(0),
                   cot = (to_P(0) * to_Q(0) + to_P(1) * to_Q(1)) / cross, q = w12 / (w * w);
      sum += rule.weight(i) * rule.weight(j) * area * q * q * (1.0 + 2.0 * cot * cot / (1.0 + nu));
    }
  return sum * p.size * p.size / (in.material.shear() * thickness(in));
}

/// Forces of the corners at q_12 = 1.
VecX corner_forces(const Plane& p) {
  const auto cross = [](const Vec3& a, const Vec3& b) { return a(0) * b(1) - a(1) * b(0); };
  const Vec3 side = p.x[1] - p.x[0], d13 = (p.x[2] - p.x[0]).normalized(),
             d24 = (p.x[3] - p.x[1]).normalized(), e14 = p.x[3] - p.x[0], e23 = p.x[2] - p.x[1];
  const double a1 = 0.5 * p.size * cross(side, e14) / cross(d13, e14),
               a2 = 0.5 * p.size * cross(side, e23) / cross(d24, e23);
  VecX a(12);
  a << a1 * p.d13, a2 * p.d24, -a1 * p.d13, -a2 * p.d24;
  return a;
}

void stiffness(const ElementInput& in, MatX& out) {
  const Plane p = plane_of(in);
  const VecX a = corner_forces(p);
  out = a * a.transpose() / flexibility(in, p);
}

/// The mean of its two divisions into triangles.
void scalar_mass(const ElementInput& in, MatX& out) {
  constexpr std::array<std::array<int, 3>, 4> triangles{
      {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
  out = MatX::Zero(4, 4);
  for (const auto& t : triangles) {
    const double area = 0.5 * (in.p[t[1]] - in.p[t[0]]).cross(in.p[t[2]] - in.p[t[0]]).norm(),
                 m = 0.5 * in.material.density * in.shell.thickness * area / 12.0;
    for (const int i : t)
      for (const int j : t) out(i, j) += i == j ? 2.0 * m : m;
  }
}

/// Its part of the stress stiffness is neglected, as is its stress.
void stressed_points(const ElementInput&, std::vector<StressedPoint>& points) { points.clear(); }

constexpr std::array<shape::Corners, 2> corners{{{0, 1, 2, 3}, {0, 3, 2, 1}}};
constexpr auto faces = shape::linear(corners);

}  // namespace

constinit const ElementKernel shear4_kernel{.family = ElementFamily::panel,
                                            .nodes = 4,
                                            .dofs_per_node = 3,
                                            .error = &error,
                                            .stiffness = &stiffness,
                                            .mass = &mass_of_translations<&scalar_mass>,
                                            .scalar_mass = &scalar_mass,
                                            .stressed_points = &stressed_points,
                                            .shape = {.faces = faces}};

}  // namespace floatframe
