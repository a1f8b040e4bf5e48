// 2-node beam in space, straight, of one section: linear axial and torsion, bending in two planes
// as a beam without distributed load bends, of Timoshenko's theory with the shear area As of the
// plane, of Euler's and Bernoulli's if As = 0. Local axes T = [x y z] (beam_axes), degrees of
// freedom (u v w rx ry rz) at each end; without shear rz = v', ry = -w'. With s = x/L,
// phi = 12 EI/(G As L^2) (0 without shear) and the shape functions of the end values:
//   axial, torsion  N = (1 - s, s):  K = EA/L [1 -1; -1 1] of u, GJ/L [1 -1; -1 1] of rx
//   bending         of (v, rz) at both ends, over 1 + phi:
//                   N = (1 - 3 s^2 + 2 s^3 + phi (1 - s),  L (s - 2 s^2 + s^3 + phi/2 (s - s^2)),
//                        3 s^2 - 2 s^3 + phi s,            L (s^3 - s^2 - phi/2 (s - s^2)))
//                   T = (6/L (s^2 - s), 1 - 4 s + 3 s^2 + phi (1 - s),
//                        6/L (s - s^2), 3 s^2 - 2 s + phi s)  the rotation of the section
//                   K = int EI T' T'^T + G As (N' - T) (N' - T)^T dx, EIz in xy, EIy in xz
//   mass            rho A int N N^T dx of u, v, w; with section inertia also rho I int T T^T dx
//                   of v, w and rho (Iy + Iz) int N N^T dx of rx
//   scalar mass     rho A L/6 [2 1; 1 2]
// An element of linear shapes integrated at its middle, K = L (EI kappa^2 + S gamma^2), is the same
// with 1/S = 1/(G As) + L^2/(12 EI); so Abaqus's, 1/S = (1 + c L^2 A/(12 I))/(G As) with its
// slenderness compensation c, has phi = 12 EI/(G As L^2) + c E A/(G As) - 1 > -1.
// Displacements of second order: R = exp(theta) of sections has the torsional curvature
//   theta_1' - 1/2 (theta_2 theta_3' - theta_3 theta_2')
// on which a torque works (a beam bent in two planes twists), and fibres off the axis lengthen
// by 1/2 (y^2 + z^2) rx'^2, on which tension works.
// K and M are rotated to body axes by T on each group of three. The response to end loads is exact.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), stiffness with shear,
// consistent mass with rotary and torsional inertia.
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"

namespace floatframe {
namespace {

using Mat12 = Eigen::Matrix<double, 12, 12>;

/// Adds a 4 x 4 bending matrix of (d1, slope1, d2, slope2) to the local matrix. In the xy plane (v,
/// rz) the slope is v' = rz, in the xz plane (w, ry) it is w' = -ry.
void add_bending(const Eigen::Matrix4d& b, bool xz_plane, Mat12& m) {
  const int dofs[4] = {xz_plane ? 2 : 1, xz_plane ? 4 : 5, xz_plane ? 8 : 7, xz_plane ? 10 : 11};
  const double sign[4] = {1.0, xz_plane ? -1.0 : 1.0, 1.0, xz_plane ? -1.0 : 1.0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) m(dofs[i], dofs[j]) += sign[i] * sign[j] * b(i, j);
  }
}

void add_linear(int dof, double diagonal, double off_diagonal, Mat12& m) {
  m(dof, dof) += diagonal;
  m(dof + 6, dof + 6) += diagonal;
  m(dof, dof + 6) += off_diagonal;
  m(dof + 6, dof) += off_diagonal;
}

void to_body_axes(const Mat3& T, const Mat12& local, MatX& out) {
  out.resize(12, 12);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      out.block<3, 3>(3 * i, 3 * j) = T * local.block<3, 3>(3 * i, 3 * j) * T.transpose();
    }
  }
}

std::string error(const ElementInput& in) {
  const Vec3 d = in.p[1] - in.p[0];
  const double length = d.norm();
  // A shorter one is round-off of the coordinates.
  if (!(length > 1e-12 * (in.p[0].norm() + in.p[1].norm()))) return "has zero length";
  const double r = in.reference.norm();
  if (!(r > 0.0)) return "has a reference vector of zero length";
  // Its component across the axis gives y: a smaller one is round-off of numbers in files.
  if (d.cross(in.reference).norm() < 1e-6 * length * r) {
    return "has a reference vector parallel to its axis";
  }
  const BeamSection& s = in.section;
  if (!(s.slenderness >= 0.0) || !std::isfinite(s.slenderness)) {
    return "has a slenderness compensation that is negative or no number";
  }
  if (!(s.shear_y >= 0.0 && s.shear_z >= 0.0 && std::isfinite(s.shear_y + s.shear_z))) {
    return "has a shear area that is negative or no number";
  }
  if (!(s.A > 0.0) || !(s.Iy > 0.0) || !(s.Iz > 0.0) || !(s.J > 0.0)) {
    return "has a section whose A, Iy, Iz and J are not all positive";
  }
  return {};
}

/// phi of a plane.
double shear_ratio(const ElementInput& in, double L, bool xz_plane) {
  const BeamSection& s = in.section;
  const double area = xz_plane ? s.shear_z : s.shear_y;
  if (!(area > 0.0)) return 0.0;
  const double ratio = in.material.young / (in.material.shear() * area);
  const double exact = 12.0 * (xz_plane ? s.Iy : s.Iz) / (L * L) * ratio;
  return s.slenderness > 0.0 ? exact + s.slenderness * s.A * ratio - 1.0 : exact;
}

/// Over EI.
Eigen::Matrix4d bending_stiffness(double L, double phi) {
  const double near = (4 + phi) * L * L, far = (2 - phi) * L * L;
  Eigen::Matrix4d b;
  b << 12, 6 * L, -12, 6 * L,    //
      6 * L, near, -6 * L, far,  //
      -12, -6 * L, 12, -6 * L,   //
      6 * L, far, -6 * L, near;
  return b / (L * L * L * (1 + phi));
}

/// int N N^T ds, times 420.
Eigen::Matrix4d translation_mass(double L, double phi) {
  const double p2 = phi * phi;
  const double a = 156 + 294 * phi + 140 * p2, b = (22 + 38.5 * phi + 17.5 * p2) * L,
               c = 54 + 126 * phi + 70 * p2, d = (13 + 31.5 * phi + 17.5 * p2) * L,
               e = (4 + 7 * phi + 3.5 * p2) * L * L, f = (3 + 7 * phi + 3.5 * p2) * L * L;
  Eigen::Matrix4d t;
  t << a, b, c, -d,  //
      b, e, d, -f,   //
      c, d, a, -b,   //
      -d, -f, -b, e;
  return t / ((1 + phi) * (1 + phi));
}

/// L^2 int T T^T ds, times 30.
Eigen::Matrix4d rotation_mass(double L, double phi) {
  const double p2 = phi * phi;
  const double b = (3 - 15 * phi) * L, e = (4 + 5 * phi + 10 * p2) * L * L,
               f = (1 + 5 * phi - 5 * p2) * L * L;
  Eigen::Matrix4d r;
  r << 36, b, -36, b,   //
      b, e, -b, -f,     //
      -36, -b, 36, -b,  //
      b, -f, -b, e;
  return r / ((1 + phi) * (1 + phi));
}

void stiffness(const ElementInput& in, MatX& out) {
  const double L = (in.p[1] - in.p[0]).norm();
  const double E = in.material.young;
  Mat12 k = Mat12::Zero();
  const double axial = E * in.section.A / L;
  const double torsion = in.material.shear() * in.section.J / L;
  add_linear(0, axial, -axial, k);
  add_linear(3, torsion, -torsion, k);
  add_bending(E * in.section.Iz * bending_stiffness(L, shear_ratio(in, L, false)), false, k);
  add_bending(E * in.section.Iy * bending_stiffness(L, shear_ratio(in, L, true)), true, k);
  to_body_axes(beam_axes(in), k, out);
}

void mass(const ElementInput& in, bool section_inertia, MatX& out) {
  const double L = (in.p[1] - in.p[0]).norm();
  const double rho = in.material.density;
  const double line = rho * in.section.A * L;
  const double phi_y = shear_ratio(in, L, false), phi_z = shear_ratio(in, L, true);
  Mat12 m = Mat12::Zero();
  add_linear(0, line / 3.0, line / 6.0, m);
  add_bending(line / 420.0 * translation_mass(L, phi_y), false, m);
  add_bending(line / 420.0 * translation_mass(L, phi_z), true, m);
  if (section_inertia) {
    const double f = rho / (30.0 * L);
    add_bending(in.section.Iz * (f * rotation_mass(L, phi_y)), false, m);
    add_bending(in.section.Iy * (f * rotation_mass(L, phi_z)), true, m);
    const double polar = rho * (in.section.Iy + in.section.Iz) * L;
    add_linear(3, polar / 3.0, polar / 6.0, m);
  }
  to_body_axes(beam_axes(in), m, out);
}

void scalar_mass(const ElementInput& in, MatX& out) {
  line_mass(in.material.density * in.section.A * (in.p[1] - in.p[0]).norm(), out);
}

/// Shapes of bending in a plane at s = x/L, of (d1, slope1, d2, slope2).
struct BendingShapes {
  Eigen::Vector4d N, dN;  ///< displacement, its derivative
  Eigen::Vector4d T, dT;  ///< rotation of the section, its derivative

  BendingShapes(double s, double L, double phi) {
    const double s2 = s * s, s3 = s2 * s, half = 0.5 * phi * (1 - 2 * s);
    N << 1 - 3 * s2 + 2 * s3 + phi * (1 - s), L * (s - 2 * s2 + s3 + 0.5 * phi * (s - s2)),
        3 * s2 - 2 * s3 + phi * s, L * (s3 - s2 - 0.5 * phi * (s - s2));
    dN << (6 * s2 - 6 * s - phi) / L, 1 - 4 * s + 3 * s2 + half, (6 * s - 6 * s2 + phi) / L,
        3 * s2 - 2 * s - half;
    T << 6 / L * (s2 - s), 1 - 4 * s + 3 * s2 + phi * (1 - s), 6 / L * (s - s2),
        3 * s2 - 2 * s + phi * s;
    dT << 6 * (2 * s - 1) / (L * L), (6 * s - 4 - phi) / L, 6 * (1 - 2 * s) / (L * L),
        (6 * s - 2 + phi) / L;
    for (Eigen::Vector4d* shape : {&N, &dN, &T, &dT}) *shape /= 1 + phi;
  }
};

using Row12 = Eigen::Matrix<double, 1, 12>;

/// A shape of bending in the local degrees of freedom: v from (v, rz), w from (w, -ry).
Row12 bending_row(const Eigen::Vector4d& shape, bool xz_plane) {
  Row12 row = Row12::Zero();
  const double sign = xz_plane ? -1.0 : 1.0;
  row(xz_plane ? 2 : 1) = shape(0);
  row(xz_plane ? 4 : 5) = sign * shape(1);
  row(xz_plane ? 8 : 7) = shape(2);
  row(xz_plane ? 10 : 11) = sign * shape(3);
  return row;
}

Row12 linear_row(int dof, double at_first, double at_second) {
  Row12 row = Row12::Zero();
  row(dof) = at_first;
  row(dof + 6) = at_second;
  return row;
}

/// Of degrees of freedom in body axes.
template <class Rows>
MatX in_body_dofs(const Mat3& T, const Rows& local) {
  MatX out(local.rows(), 12);
  for (int a = 0; a < 4; ++a)
    out.middleCols<3>(3 * a) = local.template middleCols<3>(3 * a) * T.transpose();
  return out;
}

using Rows3 = Eigen::Matrix<double, 3, 12>;

/// Rotation of the section (rx, -w', v' without shear) and its derivative along the axis, local
/// axes.
void section_rotation(const BendingShapes& v, const BendingShapes& w, double s, double L,
                      Rows3& theta, Rows3& rate) {
  theta.row(0) = linear_row(3, 1 - s, s);
  theta.row(1) = -bending_row(w.T, true);
  theta.row(2) = bending_row(v.T, false);
  rate.row(0) = linear_row(3, -1 / L, 1 / L);
  rate.row(1) = -bending_row(w.dT, true);
  rate.row(2) = bending_row(v.dT, false);
}

/// Four points: products of the shapes are of degree six.
void mass_stations(const ElementInput& in, std::vector<MassStation>& stations) {
  static const LineRule rule = gauss_jacobi(4, 0);
  const double L = (in.p[1] - in.p[0]).norm();
  const Mat3 T = beam_axes(in);
  const double phi_v = shear_ratio(in, L, false), phi_w = shear_ratio(in, L, true);
  stations.resize(4);
  for (int q = 0; q < 4; ++q) {
    const double s = rule.u(q), line = in.material.density * rule.weight(q) * L;
    const BendingShapes v(s, L, phi_v), w(s, L, phi_w);
    Rows3 u, theta, rate;
    u.row(0) = linear_row(0, 1 - s, s);
    u.row(1) = bending_row(v.N, false);
    u.row(2) = bending_row(w.N, true);
    section_rotation(v, w, s, L, theta, rate);
    MassStation& station = stations[static_cast<std::size_t>(q)];
    station.shares = Vec2(1 - s, s);
    station.mass = line * in.section.A;
    station.axes = T;
    station.moments = line * Vec3(0.0, in.section.Iz, in.section.Iy);
    station.u = T * in_body_dofs(T, u);
    station.theta = T * in_body_dofs(T, theta);
  }
}

/// Action of stress on slopes at s: the axial force N on v' and w', and N (Iy + Iz)/A on rx'.
StressedPoint tension_point(const ElementInput& in, const Mat3& T, double L, double s, double dx) {
  const BendingShapes v(s, L, shear_ratio(in, L, false)), w(s, L, shear_ratio(in, L, true));
  const double radius = std::sqrt((in.section.Iy + in.section.Iz) / in.section.A);
  Rows3 slopes;
  slopes.row(0) = radius * linear_row(3, -1 / L, 1 / L);
  slopes.row(1) = bending_row(v.dN, false);
  slopes.row(2) = bending_row(w.dN, true);
  const MatX fields = T * in_body_dofs(T, slopes);
  const Vec3 t = T.col(0);
  StressedPoint point;
  const double force = in.material.young * in.section.A * dx;
  point.stress = force * axial_stress(t) * in_body_dofs(T, linear_row(0, -1 / L, 1 / L));
  point.gradient.resize(9, 12);
  for (int i = 0; i < 3; ++i) point.gradient.middleRows<3>(3 * i) = t * fields.row(i);
  return point;
}

/// Action of a torque on the twist of second order, -1/2 (theta_2 theta_3' - theta_3 theta_2').
StressedPoint twist_point(const ElementInput& in, const Mat3& T, double L, double s, double dx) {
  const BendingShapes v(s, L, shear_ratio(in, L, false)), w(s, L, shear_ratio(in, L, true));
  Rows3 theta, rate;
  section_rotation(v, w, s, L, theta, rate);
  const double stiffness = in.material.shear() * in.section.J * dx;
  StressedPoint point;
  point.twist = true;
  point.stress = MatX::Zero(6, 12);
  point.stress.row(3) = -0.5 * stiffness * in_body_dofs(T, rate.row(0));
  Eigen::Matrix<double, 9, 12> fields = Eigen::Matrix<double, 9, 12>::Zero();
  fields.row(0) = theta.row(1);
  fields.row(1) = rate.row(2);
  fields.row(3) = theta.row(2);
  fields.row(4) = -rate.row(1);
  point.gradient = in_body_dofs(T, fields);
  return point;
}

/// Tension at three points and torque at two: exact.
void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  static const LineRule three = gauss_jacobi(3, 0), two = gauss_jacobi(2, 0);
  const double L = (in.p[1] - in.p[0]).norm();
  const Mat3 T = beam_axes(in);
  points.clear();
  for (int q = 0; q < 3; ++q)
    points.push_back(tension_point(in, T, L, three.u(q), three.weight(q) * L));
  for (int q = 0; q < 2; ++q) points.push_back(twist_point(in, T, L, two.u(q), two.weight(q) * L));
}

}  // namespace

Mat3 beam_axes(const ElementInput& in) {
  Mat3 T;
  const Vec3 x = (in.p[1] - in.p[0]).normalized();
  const Vec3 y = (in.reference - x * x.dot(in.reference)).normalized();
  T.col(0) = x;
  T.col(1) = y;
  T.col(2) = x.cross(y);
  return T;
}

constinit const ElementKernel beam2_kernel{.family = ElementFamily::beam,
                                           .nodes = 2,
                                           .dofs_per_node = 6,
                                           .error = &error,
                                           .stiffness = &stiffness,
                                           .mass = &mass,
                                           .scalar_mass = &scalar_mass,
                                           .mass_stations = &mass_stations,
                                           .stressed_points = &stressed_points};

}  // namespace floatframe
