#include "floatframe/fe/elasticity.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace floatframe {
namespace {

/// Indices of xx, yy, xy among the six, and the others.
constexpr int in_plane[3] = {0, 1, 3}, across[3] = {2, 4, 5};

Mat3 plane_of(const Mat6& D) {
  Mat3 out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = D(in_plane[i], in_plane[j]);
  return out;
}

struct NamedConstant {
  const char* name;
  double value;
};

}  // namespace

Mat3 Orientation::at(const Vec3& p) const {
  if (kind == Kind::rectangular) return axes * turn;
  const Vec3 local = axes.transpose() * (p - origin);
  const double around = std::atan2(local(1), local(0));
  const double c = std::cos(around), s = std::sin(around);
  Mat3 here;
  if (kind == Kind::cylindrical) {
    here << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    const double from_pole = std::atan2(std::hypot(local(0), local(1)), local(2));
    const double cp = std::cos(from_pole), sp = std::sin(from_pole);
    here << sp * c, cp * c, -s, sp * s, cp * s, c, cp, -sp, 0;
  }
  return axes * here * turn;
}

Mat6 elasticity_matrix(const Material& material) {
  if (material.elasticity) return *material.elasticity;
  const double nu = material.poisson;
  const double c = material.young / ((1.0 + nu) * (1.0 - 2.0 * nu));
  Mat6 D = Mat6::Zero();
  D.topLeftCorner<3, 3>().setConstant(c * nu);
  for (int i = 0; i < 3; ++i) {
    D(i, i) = c * (1.0 - nu);
    D(3 + i, 3 + i) = material.shear();
  }
  return D;
}

Mat6 turned_elasticity(const Mat6& D, const Mat3& R) {
  constexpr int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Mat6 T;
  for (int row = 0; row < 6; ++row) {
    const int i = at[row][0], j = at[row][1];
    for (int column = 0; column < 6; ++column) {
      const int a = at[column][0], b = at[column][1];
      T(row, column) = R(i, a) * R(j, b) + (a == b ? 0.0 : R(i, b) * R(j, a));
    }
  }
  const Mat6 TD = T * D;
  const Mat6 out = TD * T.transpose();
  return 0.5 * (out + out.transpose());
}

Mat3 plane_stress(const Material& m) {
  Mat3 Q;
  if (!m.elasticity) {
    const double c = m.young / (1.0 - m.poisson * m.poisson);
    Q << c, c * m.poisson, 0, c * m.poisson, c, 0, 0, 0, m.shear();
    return Q;
  }
  if (m.plane) return plane_of(*m.elasticity);
  // No stress zz, yz, zx: their strains follow from the others.
  Mat3 out_of_plane, coupling;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      out_of_plane(i, j) = (*m.elasticity)(across[i], across[j]);
      coupling(i, j) = (*m.elasticity)(in_plane[i], across[j]);
    }
  const Mat3 follow = out_of_plane.inverse() * coupling.transpose();
  Q = plane_of(*m.elasticity) - coupling * follow;
  return 0.5 * (Q + Q.transpose());
}

Mat3 turned_plane(const Mat3& Q, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 T;  // strain in the axes of the material
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  const Mat3 QT = Q * T;
  const Mat3 out = T.transpose() * QT;
  return 0.5 * (out + out.transpose());
}

Mat6 elasticity_of(const EngineeringConstants& c) {
  Mat3 S;
  S << 1.0 / c.E1, -c.nu12 / c.E1, -c.nu13 / c.E1,  //
      -c.nu12 / c.E1, 1.0 / c.E2, -c.nu23 / c.E2,   //
      -c.nu13 / c.E1, -c.nu23 / c.E2, 1.0 / c.E3;
  Mat6 D = Mat6::Zero();
  const Mat3 N = S.inverse();
  D.topLeftCorner<3, 3>() = 0.5 * (N + N.transpose());
  D(3, 3) = c.G12;
  D(4, 4) = c.G23;
  D(5, 5) = c.G13;
  return D;
}

Mat6 layer_elasticity(const Mat3& Q, double G13, double G23) {
  Mat6 D = Mat6::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) D(in_plane[i], in_plane[j]) = Q(i, j);
  D(4, 4) = G23;
  D(5, 5) = G13;
  return D;
}

Mat6 lamina_elasticity(const EngineeringConstants& c) {
  const double nu21 = c.nu12 * c.E2 / c.E1, d = 1.0 - c.nu12 * nu21;
  Mat3 Q = Mat3::Zero();
  Q(0, 0) = c.E1 / d;
  Q(1, 1) = c.E2 / d;
  Q(0, 1) = Q(1, 0) = c.nu12 * c.E2 / d;
  Q(2, 2) = c.G12;
  return layer_elasticity(Q, c.G13, c.G23);
}

std::string engineering_error(const EngineeringConstants& c, bool lamina) {
  const NamedConstant moduli[] = {{"E1", c.E1}, {"E2", c.E2},   {"G12", c.G12},
                                  {"E3", c.E3}, {"G13", c.G13}, {"G23", c.G23}};
  for (int k = 0; k < (lamina ? 3 : 6); ++k)
    if (!(moduli[k].value > 0.0) || !std::isfinite(moduli[k].value))
      return fmt::format("{} is {:g}, expected more than 0", moduli[k].name, moduli[k].value);
  struct Ratio {
    const char *name, *limit;
    double value, largest;
  };
  const Ratio ratios[] = {{"NU12", "E1/E2", c.nu12, std::sqrt(c.E1 / c.E2)},
                          {"NU13", "E1/E3", c.nu13, lamina ? 0.0 : std::sqrt(c.E1 / c.E3)},
                          {"NU23", "E2/E3", c.nu23, lamina ? 0.0 : std::sqrt(c.E2 / c.E3)}};
  for (int k = 0; k < (lamina ? 1 : 3); ++k)
    if (!(std::abs(ratios[k].value) < ratios[k].largest))
      return fmt::format("{} is {:g}, expected a size below {:g}, the root of {}", ratios[k].name,
                         ratios[k].value, ratios[k].largest, ratios[k].limit);
  if (lamina) return {};
  const double nu21 = c.nu12 * c.E2 / c.E1, nu31 = c.nu13 * c.E3 / c.E1,
               nu32 = c.nu23 * c.E3 / c.E2;
  const double rest =
      1.0 - c.nu12 * nu21 - c.nu23 * nu32 - c.nu13 * nu31 - 2.0 * nu21 * nu32 * c.nu13;
  if (!(rest > 0.0))
    return fmt::format(
        "NU12, NU13 and NU23 are {:g}, {:g} and {:g}, which together are too large: "
        "1 - NU12 NU21 - NU23 NU32 - NU13 NU31 - 2 NU21 NU32 NU13 is {:g}, expected more than 0",
        c.nu12, c.nu13, c.nu23, rest);
  return {};
}

std::string elasticity_error(const Mat6& D, bool plane,
                             const std::function<std::string(int i, int j)>& name) {
  const std::array<int, 6> order =
      plane ? std::array<int, 6>{0, 1, 3, 4, 5, 2} : std::array<int, 6>{0, 1, 2, 3, 4, 5};
  const int n = plane ? 3 : 6;
  for (int k = 0; k < n; ++k) {
    const double d = D(order[k], order[k]);
    if (!(d > 0.0) || !std::isfinite(d))
      return fmt::format("{} is {:g}, expected more than 0", name(order[k], order[k]), d);
  }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      const int a = order[i], b = order[j];
      const double most = std::sqrt(D(a, a) * D(b, b));
      if (!(std::abs(D(a, b)) < most))
        return fmt::format("{} is {:g}, expected a size below {:g}, the root of {} {}", name(a, b),
                           D(a, b), most, name(a, a), name(b, b));
    }
  MatX scaled(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      scaled(i, j) =
          D(order[i], order[j]) / std::sqrt(D(order[i], order[i]) * D(order[j], order[j]));
  // Pivots of the elimination: the first that is not positive identifies the constant.
  for (int k = 0; k < n; ++k) {
    if (!(scaled(k, k) > 1e-12))
      return fmt::format(
          "{} is {:g}, too small for the constants before it: the matrix is not positive definite",
          name(order[k], order[k]), D(order[k], order[k]));
    for (int i = k + 1; i < n; ++i)
      for (int j = k + 1; j < n; ++j) scaled(i, j) -= scaled(i, k) * scaled(k, j) / scaled(k, k);
  }
  return {};
}

std::string elasticity_name(int i, int j) {
  constexpr const char* names[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  return fmt::format("D({}, {})", names[i], names[j]);
}

Material anisotropic_material(const Mat6& D, bool plane, double density) {
  Material m;
  m.density = density;
  m.elasticity = D;
  m.plane = plane;
  const Mat3 S = plane_stress(m).inverse();
  m.young = 1.0 / S(0, 0);
  m.poisson = -S(0, 1) / S(0, 0);
  return m;
}

}  // namespace floatframe
