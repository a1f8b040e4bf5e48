// Flat thin shells with six dofs per node: tri3 is one triangle (shell_triangle.hpp), quad4 the
// mean of its two divisions into triangles (each with half its matrices), which also serves
// quadrilaterals that are not flat. Scalar mass: of displacements that are linear in each triangle.
#include <cmath>

#include "floatframe/fe/shell_triangle.hpp"

namespace floatframe {
namespace {

struct Part {
  std::array<int, 3> nodes;
  double weight;
};
constexpr Part triangle[] = {{{0, 1, 2}, 1.0}};
constexpr Part quadrilateral[] = {
    {{0, 1, 2}, 0.5}, {{0, 2, 3}, 0.5}, {{0, 1, 3}, 0.5}, {{1, 2, 3}, 0.5}};

template <int nodes>
std::span<const Part> parts() {
  if constexpr (nodes == 3) return triangle;
  return quadrilateral;
}

std::array<Vec3, 3> corners(const ElementInput& in, const Part& part) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = in.p[part.nodes[i]];
  return p;
}

template <int nodes>
std::string error(const ElementInput& in) {
  if (!(in.shell.thickness > 0.0) || !std::isfinite(in.shell.thickness)) {
    return "has a thickness that is not positive";
  }
  double size = 0.0;
  for (std::size_t a = 1; a < nodes; ++a) size = std::max(size, (in.p[a] - in.p[0]).norm());
  const Vec3 n =
      (in.p[nodes == 3 ? 1 : 2] - in.p[0]).cross(in.p[nodes - 1] - in.p[nodes == 3 ? 0 : 1]);
  for (const Part& part : parts<nodes>()) {
    const std::array<Vec3, 3> p = corners(in, part);
    const double twice = (p[1] - p[0]).cross(p[2] - p[0]).dot(n.normalized());
    // Thinner than 1e-9 of its size it is flat to the digits of its coordinates.
    if (!(twice > 1e-9 * size * size)) {
      return nodes == 3 ? "is flat (its corners lie on a line)"
                        : "is not convex, or its corners are in the wrong order";
    }
  }
  return {};
}

template <int nodes, class Add>
void for_blocks(const Part& part, const Add& add) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      add(part.nodes[i], part.nodes[j], i, j);
    }
  }
}

template <int nodes>
void stiffness(const ElementInput& in, MatX& out) {
  out = MatX::Zero(6 * nodes, 6 * nodes);
  for (const Part& part : parts<nodes>()) {
    const Mat18 K = shell_triangle_stiffness(corners(in, part), in.material, in.shell.thickness);
    for_blocks<nodes>(part, [&](int a, int b, int i, int j) {
      out.block<6, 6>(6 * a, 6 * b) += part.weight * K.block<6, 6>(6 * i, 6 * j);
    });
  }
}

template <int nodes>
void mass(const ElementInput& in, bool section_inertia, MatX& out) {
  out = MatX::Zero(6 * nodes, 6 * nodes);
  for (const Part& part : parts<nodes>()) {
    const Mat18 M =
        shell_triangle_mass(corners(in, part), in.material, in.shell.thickness, section_inertia);
    for_blocks<nodes>(part, [&](int a, int b, int i, int j) {
      out.block<6, 6>(6 * a, 6 * b) += part.weight * M.block<6, 6>(6 * i, 6 * j);
    });
  }
}

template <int nodes>
void scalar_mass(const ElementInput& in, MatX& out) {
  MatX M;
  mass<nodes>(in, false, M);
  out.resize(nodes, nodes);
  for (int a = 0; a < nodes; ++a) {
    for (int b = 0; b < nodes; ++b) out(a, b) = M(6 * a, 6 * b);
  }
}

/// One in each triangle: displacements that are linear in it, the mean membrane forces.
template <int nodes>
void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  points.resize(parts<nodes>().size());
  std::size_t q = 0;
  for (const Part& part : parts<nodes>()) {
    const std::array<Vec3, 3> p = corners(in, part);
    const double area = triangle_area(p);
    const Mat3 R = triangle_axes(p);
    const auto N = shell_triangle_membrane(p, in.material, in.shell.thickness);
    const Eigen::Matrix<double, 6, 18> stress = part.weight * area * from_triangle_axes(R) * N;
    StressedPoint& point = points[q++];
    point.stress = MatX::Zero(6, 6 * nodes);
    point.gradient = MatX::Zero(9, 6 * nodes);
    for (int a = 0; a < 3; ++a) {
      const int to = 6 * part.nodes[a];
      point.stress.middleCols<6>(to) = stress.middleCols<6>(6 * a);
      const Vec3 side = p[(a + 2) % 3] - p[(a + 1) % 3];
      const Vec3 g = R.col(2).cross(side) / (2.0 * area);
      for (int i = 0; i < 3; ++i) point.gradient.block<3, 1>(3 * i, to + i) = g;
    }
  }
}

/// At a corner of a quadrilateral: the mean of its two divisions, of which one has two triangles
/// there.
template <int nodes>
void layer_stresses(const ElementInput& in, MatX& out) {
  out = MatX::Zero(12 * nodes, 6 * nodes);
  for (int a = 0; a < nodes; ++a) {
    std::array<int, 2> count{};  // of the triangles of each division at this corner
    const auto corner_of = [&](const Part& part) {
      for (int i = 0; i < 3; ++i)
        if (part.nodes[i] == a) return i;
      return -1;
    };
    const std::span<const Part> all = parts<nodes>();
    for (std::size_t k = 0; k < all.size(); ++k) count[k / 2] += corner_of(all[k]) >= 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int corner = corner_of(all[k]);
      if (corner < 0) continue;
      const auto S =
          shell_triangle_stress(corners(in, all[k]), in.material, in.shell.thickness, corner);
      for (int i = 0; i < 3; ++i)
        out.block<12, 6>(12 * a, 6 * all[k].nodes[i]) +=
            (nodes == 3 ? 1.0 : 0.5) / count[k / 2] * S.middleCols<6>(6 * i);
    }
  }
}

constexpr std::array<shape::Corners, 2> tri_corners{{{0, 1, 2, -1}, {0, 2, 1, -1}}};
constexpr std::array<shape::Corners, 2> quad_corners{{{0, 1, 2, 3}, {0, 3, 2, 1}}};
constexpr auto tri_faces = shape::linear(tri_corners);
constexpr auto quad_faces = shape::linear(quad_corners);

template <int count>
constexpr ElementKernel shell_kernel(std::span<const FaceNodes> faces) {
  return {.family = ElementFamily::shell,
          .nodes = count,
          .dofs_per_node = 6,
          .error = &error<count>,
          .stiffness = &stiffness<count>,
          .mass = &mass<count>,
          .scalar_mass = &scalar_mass<count>,
          .stressed_points = &stressed_points<count>,
          .layer_stresses = &layer_stresses<count>,
          .shape = {.faces = faces}};
}

}  // namespace

constinit const ElementKernel tri3_kernel = shell_kernel<3>(tri_faces);
constinit const ElementKernel quad4_kernel = shell_kernel<4>(quad_faces);

}  // namespace floatframe
