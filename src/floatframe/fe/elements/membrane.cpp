// Membranes: sheets that carry forces in their surface and have neither bending nor transverse
// shear stiffness, three translations per node. Isoparametric, on the shapes of faces. At a point
// with the axes e_1, e_2 in the surface, e_1 along the first side of the parent domain in its
// middle, the strains (xx, yy, 2 xy) are
//   e = sum_a (e_1 N_a,1; e_2 N_a,2; e_1 N_a,2 + e_2 N_a,1) . u_a,   K = int B^T A B dA
// with A of the section (fe/shell_layers.hpp); mass int m N_a N_b dA in all directions.
//   membrane3   constant strain          membrane6   3 points
//   membrane4   2 x 2 points             membrane8   3 x 3, membrane8r 2 x 2
//   membrane4s  2 x 2 points, the shear strain of all from the middle: does not lock in plane
//               bending. Source: MacNeal, A simple quadrilateral shell element (1978)
#include <algorithm>
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/face_shape.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/fe/shell_triangle.hpp"
#include "floatframe/fe/solid_shapes.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

enum class Points { all, fewer, shear_in_the_middle };

QuadratureRule square_rule(int n) {
  const LineRule line = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int i = 0; i < n * n; ++i)
    rule.push_back({Vec3(2 * line.u(i % n) - 1, 2 * line.u(i / n) - 1, 0.0),
                    4 * line.weight(i % n) * line.weight(i / n)});
  return rule;
}

using Strain3 = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 24>;

/// A place on the surface.
struct Place {
  FaceShape shape = {};
  Mat3 R = Mat3::Identity();  ///< e_1, e_2, the normal
  double area = 0.0;          ///< over that of the parent domain
  Eigen::Matrix<double, 2, 8> slopes = Eigen::Matrix<double, 2, 8>::Zero();  ///< of N along e_1, 2
  Strain3 B = {};
};

template <int nodes>
constexpr int corner_count = nodes % 3 == 0 ? 3 : 4;

template <int nodes>
Vec3 middle() {
  return corner_count<nodes> == 3 ? Vec3(1.0 / 3.0, 1.0 / 3.0, 0.0) : Vec3::Zero();
}

/// `first`: along e_1.
template <int nodes>
Place place_at(const ElementInput& in, const Vec3& xi, const Vec3& first) {
  Place at{face_shape(corner_count<nodes>, nodes, xi(0), xi(1))};
  Vec3 r = Vec3::Zero(), s = Vec3::Zero();
  for (int a = 0; a < nodes; ++a) {
    r += at.shape.r[a] * in.p[a];
    s += at.shape.s[a] * in.p[a];
  }
  const Vec3 normal = r.cross(s);
  at.area = normal.norm();
  at.R.col(2) = normal / at.area;
  at.R.col(0) = (first - at.R.col(2) * at.R.col(2).dot(first)).normalized();
  at.R.col(1) = at.R.col(2).cross(at.R.col(0));
  const Eigen::Vector2d x(at.R.col(0).dot(r), at.R.col(0).dot(s)),
      y(at.R.col(1).dot(r), at.R.col(1).dot(s));
  at.B = Strain3::Zero(3, 3 * nodes);
  for (int a = 0; a < nodes; ++a) {
    const double d_1 = (y(1) * at.shape.r[a] - y(0) * at.shape.s[a]) / at.area,
                 d_2 = (x(0) * at.shape.s[a] - x(1) * at.shape.r[a]) / at.area;
    at.slopes.col(a) << d_1, d_2;
    at.B.middleCols<3>(3 * a) << d_1 * at.R.col(0).transpose(), d_2 * at.R.col(1).transpose(),
        d_2 * at.R.col(0).transpose() + d_1 * at.R.col(1).transpose();
  }
  return at;
}

template <int nodes>
Vec3 first_side(const ElementInput& in) {
  const Vec3 xi = middle<nodes>();
  const FaceShape shape = face_shape(corner_count<nodes>, nodes, xi(0), xi(1));
  Vec3 r = Vec3::Zero();
  for (int a = 0; a < nodes; ++a) r += shape.r[a] * in.p[a];
  return r;
}

ShellLayers layers_at(const ShellLayers& layers, const Mat3& R) {
  if (!layers.directional) return layers;
  const Vec3 local = R.transpose() * layers.axis;
  return turned_layers(layers, std::atan2(local(1), local(0)));
}

/// The points of the stiffness; strains are most accurate with few points.
template <int nodes>
QuadratureRule points_of(bool few) {
  if constexpr (nodes == 3) return {{middle<3>(), 0.5}};
  if constexpr (nodes == 6) return triangle_rule_3();
  return square_rule(nodes == 8 && !few ? 3 : 2);
}

template <int nodes>
QuadratureRule mass_points() {
  if constexpr (nodes % 3 == 0) return triangle_rule(nodes == 3 ? 2 : 4);
  return square_rule(nodes == 4 ? 3 : 5);
}

template <int nodes, Points kind, class Use>
void each_point(const ElementInput& in, bool few, const Use& use) {
  const Vec3 first = first_side<nodes>(in);
  Place centre;
  if (kind == Points::shear_in_the_middle) centre = place_at<nodes>(in, middle<nodes>(), first);
  for (const QuadraturePoint& q : points_of<nodes>(few || kind == Points::fewer)) {
    Place at = place_at<nodes>(in, q.xi, first);
    if (kind == Points::shear_in_the_middle) at.B.row(2) = centre.B.row(2);
    use(at, q.weight * at.area, q.xi);
  }
}

template <int nodes>
std::string error(const ElementInput& in) {
  if (!(in.shell.thickness > 0.0) || !std::isfinite(in.shell.thickness))
    return "has a thickness that is not positive";
  if (in.shell.offset != 0.0)
    return "has an offset from its nodes, which a membrane cannot have: it has no rotations";
  if (in.layers && in.layers->axis.isZero(0.0))
    return "lies across the first axis of its material, which must have a direction in it";
  double size = 0.0;
  for (std::size_t a = 1; a < nodes; ++a) size = std::max(size, (in.p[a] - in.p[0]).norm());
  const Vec3 first = first_side<nodes>(in), xi = middle<nodes>();
  const Place centre = place_at<nodes>(in, xi, first);
  bool good = centre.area > 1e-9 * size * size;
  const auto check = [&](const Vec3& p) {
    const Place at = place_at<nodes>(in, p, first);
    good = good && at.area * at.R.col(2).dot(centre.R.col(2)) > 1e-9 * size * size;
  };
  for (const QuadraturePoint& q : mass_points<nodes>()) check(q.xi);
  if (nodes == 4)
    for (const double r : {-1.0, 1.0})
      for (const double s : {-1.0, 1.0}) check({r, s, 0.0});
  if (good) return {};
  if (nodes > 4) return "is folded, or its nodes are in the wrong order";
  return nodes == 3 ? "is flat (its corners lie on a line)"
                    : "is not convex, or its corners are in the wrong order";
}

template <int nodes, Points kind>
void stiffness(const ElementInput& in, MatX& out) {
  const ShellLayers layers = layers_of(in);
  out = MatX::Zero(3 * nodes, 3 * nodes);
  each_point<nodes, kind>(in, false, [&](const Place& at, double area, const Vec3&) {
    const Strain3 N = area * layers_at(layers, at.R).A * at.B;
    out.noalias() += at.B.transpose() * N;
  });
  out = (0.5 * (out + out.transpose())).eval();
}

template <int nodes>
void scalar_mass(const ElementInput& in, MatX& out) {
  const double mass = layers_of(in).mass;
  const Vec3 first = first_side<nodes>(in);
  out = MatX::Zero(nodes, nodes);
  for (const QuadraturePoint& q : mass_points<nodes>()) {
    const Place at = place_at<nodes>(in, q.xi, first);
    const Eigen::Map<const Eigen::Matrix<double, nodes, 1>> N(at.shape.N.data());
    out += mass * q.weight * at.area * N * N.transpose();
  }
}

template <int nodes, Points kind>
void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  const ShellLayers layers = layers_of(in);
  points.clear();
  each_point<nodes, kind>(in, true, [&](const Place& at, double area, const Vec3&) {
    StressedPoint& point = points.emplace_back();
    point.stress = area * from_triangle_axes(at.R) * layers_at(layers, at.R).A * at.B;
    point.gradient = MatX::Zero(9, 3 * nodes);
    for (int a = 0; a < nodes; ++a) {
      const Vec3 slope = at.R.leftCols<2>() * at.slopes.col(a);
      for (int i = 0; i < 3; ++i) point.gradient.block<3, 1>(3 * i, 3 * a + i) = slope;
    }
  });
}

/// The quantity fitted to the points and extrapolated to the nodes.
template <int nodes>
VecX smooth(double r, double s) {
  if (nodes == 3) return VecX::Ones(1);
  VecX out(corner_count<nodes>);
  out.head<3>() << 1.0, r, s;
  if (corner_count<nodes> == 4) out(3) = r * s;
  return out;
}

/// Both sides have the strains of the surface.
template <int nodes, Points kind>
void layer_stresses(const ElementInput& in, MatX& out) {
  constexpr double r[2][8] = {{0, 1, 0, .5, .5, 0}, {-1, 1, 1, -1, 0, 1, 0, -1}},
                   s[2][8] = {{0, 0, 1, 0, .5, .5}, {-1, -1, 1, 1, -1, 0, 1, 0}};
  const ShellLayers layers = layers_of(in);
  const auto points = static_cast<Eigen::Index>(points_of<nodes>(true).size());
  const int terms = static_cast<int>(smooth<nodes>(0, 0).size()),
            shape = corner_count<nodes> == 3 ? 0 : 1;
  MatX at_points(points, terms), at_nodes(nodes, terms);
  std::vector<Eigen::Matrix<double, 12, Eigen::Dynamic>> stress;
  each_point<nodes, kind>(in, true, [&](const Place& at, double, const Vec3& xi) {
    at_points.row(static_cast<Eigen::Index>(stress.size())) = smooth<nodes>(xi(0), xi(1));
    const ShellLayers here = layers_at(layers, at.R);
    const Eigen::Matrix<double, 6, 3> turn = from_triangle_axes(at.R);
    auto& both = stress.emplace_back(12, 3 * nodes);
    both << turn * here.top.membrane * at.B, turn * here.bottom.membrane * at.B;
  });
  for (int a = 0; a < nodes; ++a) at_nodes.row(a) = smooth<nodes>(r[shape][a], s[shape][a]);
  const MatX to_nodes = at_nodes * LeastNorm(at_points).pseudo_inverse();
  out = MatX::Zero(12 * nodes, 3 * nodes);
  for (int a = 0; a < nodes; ++a)
    for (Eigen::Index q = 0; q < points; ++q)
      out.middleRows<12>(12 * a) += to_nodes(a, q) * stress[static_cast<std::size_t>(q)];
}

template <int count, Points kind = Points::all>
constexpr ElementKernel membrane_kernel(std::span<const FaceNodes> faces) {
  return {.family = ElementFamily::membrane,
          .nodes = count,
          .dofs_per_node = 3,
          .error = &error<count>,
          .stiffness = &stiffness<count, kind>,
          .mass = &mass_of_translations<&scalar_mass<count>>,
          .scalar_mass = &scalar_mass<count>,
          .stressed_points = &stressed_points<count, kind>,
          .layer_stresses = &layer_stresses<count, kind>,
          .shape = {.faces = faces}};
}

}  // namespace

constinit const ElementKernel membrane3_kernel = membrane_kernel<3>(shape::tri3_faces);
constinit const ElementKernel membrane4_kernel = membrane_kernel<4>(shape::quad4_faces);
constinit const ElementKernel membrane4s_kernel =
    membrane_kernel<4, Points::shear_in_the_middle>(shape::quad4_faces);
constinit const ElementKernel membrane6_kernel = membrane_kernel<6>(shape::tri6_faces);
constinit const ElementKernel membrane8_kernel = membrane_kernel<8>(shape::quad8_faces);
constinit const ElementKernel membrane8r_kernel =
    membrane_kernel<8, Points::fewer>(shape::quad8_faces);

}  // namespace floatframe
