// Membrane: the optimal triangle with drilling freedoms of Felippa (2003, "A study of optimal
// membrane triangles with drilling freedoms"), which is exact in plane bending of rectangular
// patches: K = L E L^T / (A h) + 3/4 beta_0 A h T^T K_theta T with plane stress E, alpha = 3/2 in L
// and beta_0 = max((1 - 4 nu^2)/2, 0.01), the values of that paper; 0.01 keeps the drilling
// stiffness positive as nu nears 1/2. Plate: discrete Kirchhoff triangle of Batoz, Bathe and Ho
// (1980); with transverse shear the discrete Kirchhoff-Mindlin triangle of Katili (1993), which
// converges to the former as the thickness falls: the rotation along side k exceeds the linear by
// 4 xi (1 - xi) D_k, with the length l and phi_k = 12 D/(G s l^2), D = E h^3/(12 (1 - nu^2)),
//   D_k = -(3/2 (w_j - w_i)/l + 3/4 (beta_i + beta_j))/(1 + phi_k),  gamma_k = -2/3 phi_k D_k
// constant shear strains gamma_k of the sides, at a corner those of its two sides, linear between.
// For a section with A, B, D (fe/shell_layers.hpp) E h is A, the plate has D, in phi_k that of the
// side's direction, and the mean membrane strain e = L^T u/S (S: area, h = 1) and the mean
// curvature k are coupled, e^T B k S. The middle of the thickness moves with the nodes,
// u + theta x z_0 n. Mass: linear displacements, rotary inertia of the thickness, none about the
// normal.
#include "floatframe/fe/shell_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

using Mat9 = Eigen::Matrix<double, 9, 9>;
using Mat39 = Eigen::Matrix<double, 3, 9>;

/// Corners in the plane of the triangle, origin in corner 1.
struct Plane {
  std::array<double, 3> x{}, y{};
  double area = 0.0;
  double dx(int i, int j) const { return x[std::size_t(i)] - x[std::size_t(j)]; }
  double dy(int i, int j) const { return y[std::size_t(i)] - y[std::size_t(j)]; }
  double square(int i, int j) const { return dx(i, j) * dx(i, j) + dy(i, j) * dy(i, j); }
};

Plane flatten(const std::array<Vec3, 3>& p, const Mat3& R) {
  Plane t;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 local = R.transpose() * (p[i] - p[0]);
    t.x[i] = local(0);
    t.y[i] = local(1);
  }
  t.area = 0.5 * (t.dx(1, 0) * t.dy(2, 0) - t.dx(2, 0) * t.dy(1, 0));
  return t;
}

/// Forces of the corners (u, v, rz) from constant membrane forces per length. Each side has a pair
/// of end moments that balance neighbours; a side with an end of independent drilling has none.
Eigen::Matrix<double, 9, 3> lumping(const Plane& t, unsigned own_drilling) {
  constexpr double alpha = 1.5;
  const auto own = [&](int corner) { return ((own_drilling >> corner) & 1u) != 0; };
  Eigen::Matrix<double, 9, 3> L;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double y = t.dy(j, k), x = t.dx(k, j);
    L.row(3 * i) << y, 0, x;
    L.row(3 * i + 1) << 0, x, y;
    L.row(3 * i + 2) << y * (t.dy(i, k) - t.dy(j, i)), x * (t.dx(k, i) - t.dx(i, j)),
        2.0 * (t.dx(k, i) * t.dy(i, k) - t.dx(i, j) * t.dy(j, i));
    if (own_drilling != 0) {  // the same as a sum over the sides, y = dy_ji + dy_ik
      const auto side = [](double dx, double dy) { return Vec3(dy * dy, dx * dx, 2.0 * dx * dy); };
      Vec3 moments = Vec3::Zero();
      if (!own(i) && !own(k)) moments += side(t.dx(k, i), t.dy(i, k));
      if (!own(i) && !own(j)) moments -= side(t.dx(i, j), t.dy(j, i));
      L.row(3 * i + 2) = moments;
    }
    L.row(3 * i + 2) *= alpha / 6.0;
  }
  return 0.5 * L;
}

/// The higher-order membrane strains, driven by the drilling rotations: at corner i 3/2 Te Q_i
/// T of (u, v, rz), xx, yy and xy in the axes of the triangle; its energy counts beta_0 times. The
/// mean of the two divisions of a rectangle then holds the stress of plane bending exactly.
struct HigherStrains {
  Mat39 T;  ///< deviation of the drilling rotations from the mean rotation of the sides
  Mat3 Te;  ///< from natural strains along the sides 12, 23, 31
  std::array<Mat3, 3> Q;  ///< natural strains at the corners

  explicit HigherStrains(const Plane& t) {
    const double A = t.area;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      for (int row = 0; row < 3; ++row) {
        T(row, 3 * i) = t.dx(k, j);
        T(row, 3 * i + 1) = t.dy(k, j);
        T(row, 3 * i + 2) = row == i ? 4.0 * A : 0.0;
      }
    }
    T /= 4.0 * A;
    const double l21 = t.square(1, 0), l32 = t.square(2, 1), l13 = t.square(0, 2);
    Te << t.dy(1, 2) * t.dy(0, 2) * l21, t.dy(2, 0) * t.dy(1, 0) * l32,
        t.dy(0, 1) * t.dy(2, 1) * l13, t.dx(1, 2) * t.dx(0, 2) * l21, t.dx(2, 0) * t.dx(1, 0) * l32,
        t.dx(0, 1) * t.dx(2, 1) * l13, (t.dy(1, 2) * t.dx(2, 0) + t.dx(2, 1) * t.dy(0, 2)) * l21,
        (t.dy(2, 0) * t.dx(0, 1) + t.dx(0, 2) * t.dy(1, 0)) * l32,
        (t.dy(0, 1) * t.dx(1, 2) + t.dx(1, 0) * t.dy(2, 1)) * l13;
    Te /= 4.0 * A * A;
    Q[0] << 1, 2, 1, 0, 1, -1, -1, -1, -2;
    Q[1] << -2, -1, -1, 1, 1, 2, -1, 0, 1;
    Q[2] << 1, -1, 0, -1, -2, -1, 2, 1, 1;
    const Vec3 sides(1.0 / l21, 1.0 / l32, 1.0 / l13);
    for (Mat3& q : Q) q = (2.0 * A / 3.0) * sides.asDiagonal() * q;
  }
};

/// Dofs (u, v, rz) per node: basic part (constant stress) + 3/4 beta_0 of the higher-order part.
Mat9 membrane(const Plane& t, const ShellLayers& s) {
  const Eigen::Matrix<double, 9, 3> L = lumping(t, s.own_drilling);
  const Mat9 basic = L * s.A * L.transpose() / t.area;

  const HigherStrains higher(t);
  const Mat3 E_natural = higher.Te.transpose() * s.A * higher.Te;
  const Mat3 Q4 = 0.5 * (higher.Q[0] + higher.Q[1]), Q5 = 0.5 * (higher.Q[1] + higher.Q[2]),
             Q6 = 0.5 * (higher.Q[2] + higher.Q[0]);
  const Mat3 K_theta = Q4.transpose() * E_natural * Q4 + Q5.transpose() * E_natural * Q5 +
                       Q6.transpose() * E_natural * Q6;
  return basic + (0.75 * s.beta_0 * t.area) * higher.T.transpose() * K_theta * higher.T;
}

/// Curvatures at a point (xi, eta) of the triangle from (w, rx, ry) of the corners.
Mat39 curvatures(const Plane& t, double xi, double eta) {
  // Sides 4, 5, 6 = 23, 31, 12; stored at 0, 1, 2.
  std::array<double, 3> a{}, b{}, c{}, d{}, e{};
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const std::size_t s = k;
    const double x = t.dx(i, j), y = t.dy(i, j), l = t.square(i, j);
    a[s] = -x / l;
    b[s] = 0.75 * x * y / l;
    c[s] = (0.25 * x * x - 0.5 * y * y) / l;
    d[s] = -y / l;
    e[s] = (0.25 * y * y - 0.5 * x * x) / l;
  }
  // Derivatives of the quadratic shape functions with respect to xi and eta.
  const double L1 = 1.0 - xi - eta;
  const Vec2 corner[3] = {Vec2::Constant(1.0 - 4.0 * L1), Vec2(4.0 * xi - 1.0, 0.0),
                          Vec2(0.0, 4.0 * eta - 1.0)};
  const Vec2 side[3] = {Vec2(4.0 * eta, 4.0 * xi), Vec2(-4.0 * eta, 4.0 * (L1 - eta)),
                        Vec2(4.0 * (L1 - xi), -4.0 * xi)};
  const double factor = 1.0 / (2.0 * t.area);
  const auto ddx = [&](const Vec2& g) { return factor * (t.dy(2, 0) * g(0) + t.dy(0, 1) * g(1)); };
  const auto ddy = [&](const Vec2& g) { return factor * (t.dx(0, 2) * g(0) + t.dx(1, 0) * g(1)); };
  Mat39 B;
  for (int i = 0; i < 3; ++i) {
    // The side before the corner and the one after it: 5 and 6 for corner 1.
    const std::size_t p = (i + 1) % 3;
    const std::size_t q = (i + 2) % 3;
    const Vec2 Hx[3] = {1.5 * (a[q] * side[q] - a[p] * side[p]), b[p] * side[p] + b[q] * side[q],
                        corner[i] - c[p] * side[p] - c[q] * side[q]};
    const Vec2 Hy[3] = {1.5 * (d[q] * side[q] - d[p] * side[p]),
                        -corner[i] + e[p] * side[p] + e[q] * side[q], -Hx[1]};
    for (int k = 0; k < 3; ++k) {
      B(0, 3 * i + k) = ddx(Hx[k]);
      B(1, 3 * i + k) = ddy(Hy[k]);
      B(2, 3 * i + k) = ddy(Hx[k]) + ddx(Hy[k]);
    }
  }
  return B;
}

/// The sides of a plate with transverse shear; side k is between corners k + 1 and k + 2.
struct ShearSides {
  std::array<Vec2, 3> along;  ///< unit vectors
  Vec3 phi;
  Mat39 D;  ///< D_k of a plate without shear, from (w, rx, ry) of the corners

  ShearSides(const Plane& t, const ShellLayers& layers) : D(Mat39::Zero()) {
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double l = std::sqrt(t.square(i, j));
      const Vec2 s(t.dx(j, i) / l, t.dy(j, i) / l);
      along[k] = s;
      const Vec3 bent(s(0) * s(0), s(1) * s(1), 2.0 * s(0) * s(1));
      phi(k) = 12.0 * bent.dot(layers.D * bent) / (s.dot(layers.shear * s) * l * l);
      D(k, 3 * i) = 1.5 / l;
      D(k, 3 * j) = -1.5 / l;
      for (const int end : {i, j}) D.row(k).segment<2>(3 * end + 1) << 0.75 * s(1), -0.75 * s(0);
    }
  }

  /// Excess of the curvatures of a plate without shear.
  Mat39 relieved(const Plane& t, double xi, double eta) const {
    const double L1 = 1.0 - xi - eta;
    const Vec2 side[3] = {Vec2(4.0 * eta, 4.0 * xi), Vec2(-4.0 * eta, 4.0 * (L1 - eta)),
                          Vec2(4.0 * (L1 - xi), -4.0 * xi)};
    Mat39 B = Mat39::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vec2 g = Vec2(t.dy(2, 0) * side[k](0) + t.dy(0, 1) * side[k](1),
                          t.dx(0, 2) * side[k](0) + t.dx(1, 0) * side[k](1)) /
                     (2.0 * t.area);
      const Vec2& s = along[k];
      const Vec3 curvature(g(0) * s(0), g(1) * s(1), g(1) * s(0) + g(0) * s(1));
      B += phi(k) / (1.0 + phi(k)) * curvature * D.row(k);
    }
    return B;
  }

  /// Shear strains (xz, yz) at a corner.
  Eigen::Matrix<double, 2, 9> at_corner(int corner) const {
    Eigen::Matrix2d directions;
    Eigen::Matrix<double, 2, 9> of_sides;
    for (int i = 0; i < 2; ++i) {
      const int k = (corner + 1 + i) % 3;
      directions.row(i) = along[k].transpose();
      of_sides.row(i) = -2.0 / 3.0 * phi(k) / (1.0 + phi(k)) * D.row(k);
    }
    const double det = directions(0, 0) * directions(1, 1) - directions(0, 1) * directions(1, 0);
    Eigen::Matrix2d inverse;
    inverse << directions(1, 1), -directions(0, 1), -directions(1, 0), directions(0, 0);
    return inverse / det * of_sides;
  }
};

/// Dofs (w, rx, ry) per node; the curvatures are linear, so the middles of the sides are exact.
/// `mean`: their mean.
Mat9 plate(const Plane& t, const ShellLayers& layers, Mat39& mean) {
  const Vec2 middle[3] = {Vec2(0.5, 0.0), Vec2(0.5, 0.5), Vec2(0.0, 0.5)};
  Mat9 K = Mat9::Zero();
  mean.setZero();
  if (layers.shear.isZero(0.0)) {
    for (const Vec2& m : middle) {
      const Mat39 B = curvatures(t, m(0), m(1));
      K += (t.area / 3.0) * B.transpose() * layers.D * B;
      mean += B / 3.0;
    }
    return K;
  }
  const ShearSides sides(t, layers);
  for (int k = 0; k < 3; ++k) {
    const Vec2& m = middle[k];
    const Mat39 B = curvatures(t, m(0), m(1)) - sides.relieved(t, m(0), m(1));
    // Between corners k and k + 1.
    const Eigen::Matrix<double, 2, 9> S = 0.5 * (sides.at_corner(k) + sides.at_corner((k + 1) % 3));
    K += (t.area / 3.0) * (B.transpose() * layers.D * B + S.transpose() * layers.shear * S);
    mean += B / 3.0;
  }
  return K;
}

void to_body_axes(const Mat3& R, Mat18& m) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Mat3 block = m.block<3, 3>(3 * i, 3 * j);
      m.block<3, 3>(3 * i, 3 * j) = R * block * R.transpose();
    }
  }
}

}  // namespace

Mat3 triangle_axes(const std::array<Vec3, 3>& p) {
  Mat3 R;
  R.col(0) = (p[1] - p[0]).normalized();
  R.col(2) = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

double triangle_area(const std::array<Vec3, 3>& p) {
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
}

TriangleSection::TriangleSection(const std::array<Vec3, 3>& p, const ShellLayers& section)
    : R(triangle_axes(p)), layers(section) {
  if (!section.directional) return;
  const Vec3 local = R.transpose() * section.axis;
  layers = turned_layers(section, std::atan2(local(1), local(0)));
}

Mat18 to_middle(const Vec3& normal, double offset) {
  Mat18 T = Mat18::Identity();
  for (int i = 0; i < 3; ++i) T.block<3, 3>(6 * i, 6 * i + 3) = -offset * skew(normal);
  return T;
}

Mat18 shell_triangle_stiffness(const std::array<Vec3, 3>& p, const ShellLayers& section) {
  const auto [R, layers] = TriangleSection(p, section);
  const Plane t = flatten(p, R);
  Mat39 mean;
  const Mat9 in_plane = membrane(t, layers), bending = plate(t, layers, mean);
  const Mat9 coupled = lumping(t, layers.own_drilling) * layers.B * mean;
  constexpr int u[9] = {0, 1, 5, 6, 7, 11, 12, 13, 17}, w[9] = {2, 3, 4, 8, 9, 10, 14, 15, 16};
  Mat18 K = Mat18::Zero();
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      K(u[i], u[j]) = in_plane(i, j);
      K(w[i], w[j]) = bending(i, j);
      K(u[i], w[j]) = K(w[j], u[i]) = coupled(i, j);
    }
  }
  to_body_axes(R, K);
  if (layers.offset != 0.0) {
    const Mat18 T = to_middle(R.col(2), layers.offset), KT = K * T;
    K = T.transpose() * KT;
  }
  return 0.5 * (K + K.transpose());
}

Eigen::Matrix<double, 3, 18> shell_triangle_membrane(const std::array<Vec3, 3>& p,
                                                     const ShellLayers& section) {
  const auto [R, layers] = TriangleSection(p, section);
  const Plane t = flatten(p, R);
  Mat39 mean;
  plate(t, layers, mean);
  const Mat39 in_plane = layers.A * lumping(t, layers.own_drilling).transpose() / t.area,
              bending = layers.B * mean;
  Eigen::Matrix<double, 3, 18> N;
  for (int i = 0; i < 3; ++i) {
    N.block<3, 3>(0, 6 * i) = in_plane.block<3, 2>(0, 3 * i) * R.leftCols<2>().transpose() +
                              bending.col(3 * i) * R.col(2).transpose();
    N.block<3, 3>(0, 6 * i + 3) = in_plane.col(3 * i + 2) * R.col(2).transpose() +
                                  bending.block<3, 2>(0, 3 * i + 1) * R.leftCols<2>().transpose();
  }
  if (layers.offset != 0.0) N = (N * to_middle(R.col(2), layers.offset)).eval();
  return N;
}

Eigen::Matrix<double, 6, 3> from_triangle_axes(const Mat3& R) {
  constexpr int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Eigen::Matrix<double, 6, 3> turn;
  for (int c = 0; c < 6; ++c) {
    const int i = at[c][0], j = at[c][1];
    turn.row(c) << R(i, 0) * R(j, 0), R(i, 1) * R(j, 1), R(i, 0) * R(j, 1) + R(i, 1) * R(j, 0);
  }
  return turn;
}

Eigen::Matrix<double, 12, 18> shell_triangle_stress(const std::array<Vec3, 3>& p,
                                                    const ShellLayers& section, int corner) {
  const auto [R, layers] = TriangleSection(p, section);
  const Plane t = flatten(p, R);
  const HigherStrains higher(t);
  Mat39 strain = lumping(t, layers.own_drilling).transpose() / t.area;
  strain += 1.5 * higher.Te * higher.Q[corner] * higher.T;
  const double xi = corner == 1 ? 1.0 : 0.0, eta = corner == 2 ? 1.0 : 0.0;
  Mat39 curvature = curvatures(t, xi, eta);
  if (!layers.shear.isZero(0.0)) curvature -= ShearSides(t, layers).relieved(t, xi, eta);
  const Eigen::Matrix<double, 6, 3> turn = from_triangle_axes(R);
  Eigen::Matrix<double, 12, 18> out;
  int row = 0;
  for (const ShellLayers::Side* side : {&layers.top, &layers.bottom}) {
    const Mat39 in_plane = side->membrane * strain, bending = side->bending * curvature;
    for (int i = 0; i < 3; ++i) {
      // (u, v, rz) and (w, rx, ry) of the corner from its displacements in body axes.
      const Mat3 u = in_plane.block<3, 2>(0, 3 * i) * R.leftCols<2>().transpose();
      const Mat3 rz = in_plane.col(3 * i + 2) * R.col(2).transpose();
      const Mat3 w = bending.col(3 * i) * R.col(2).transpose();
      const Mat3 r = bending.block<3, 2>(0, 3 * i + 1) * R.leftCols<2>().transpose();
      out.block<6, 3>(row, 6 * i) = turn * (u + w);
      out.block<6, 3>(row, 6 * i + 3) = turn * (rz + r);
    }
    row += 6;
  }
  if (layers.offset != 0.0) out = (out * to_middle(R.col(2), layers.offset)).eval();
  return out;
}

Mat18 shell_triangle_mass(const std::array<Vec3, 3>& p, const ShellLayers& section,
                          bool section_inertia) {
  const Vec3 n = triangle_axes(p).col(2);
  const double line = triangle_area(p) / 12.0, z = section.offset;
  const double moment = section.moment + z * section.mass;  // about the nodes
  double inertia = section.inertia + 2.0 * z * section.moment + z * z * section.mass;
  // Without the section inertia the remainder is a layer of all mass at its centre.
  if (!section_inertia) inertia = section.mass > 0.0 ? moment * moment / section.mass : 0.0;
  const Mat3 turning = inertia * (Mat3::Identity() - n * n.transpose());
  const Mat3 arm = -moment * skew(n);
  Mat18 M = Mat18::Zero();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const double m = line * (a == b ? 2.0 : 1.0);
      M.block<3, 3>(6 * a, 6 * b) = m * section.mass * Mat3::Identity();
      M.block<3, 3>(6 * a + 3, 6 * b + 3) = m * turning;
      M.block<3, 3>(6 * a, 6 * b + 3) = m * arm;
      M.block<3, 3>(6 * a + 3, 6 * b) = m * arm.transpose();
    }
  }
  return M;
}

}  // namespace floatframe
