// Shells with six dofs per node, built of flat triangles (shell_triangle.hpp): tri3 is one, quad4
// the mean of its two divisions into triangles (each with half its matrices), which also serves
// quadrilaterals that are not flat. tri6 is four triangles: three at the corners and one between
// the middles of the edges; quad8 four quad4 that meet in its middle, -1/4 of the corners and 1/2
// of the middles of the edges, a node that carries no load and is condensed (its mass moves with
// the same weights). They bend and stretch as a mesh twice as fine as their corners does, with all
// their nodes on the surface: constant strain and curvature are exact for any shape, errors
// fall with the square of the size. Scalar mass: of displacements that are linear in each triangle.
// Where the rotation about the normal is independent (ElementInput::own_drilling) constant stress
// has no moment there (alpha = 0 on the sides at it), so it remains exact, and the further part of
// that rotation follows the other freedoms without load: it is condensed, as is the middle
// of quad8. It has no mass.
#include <algorithm>
#include <cmath>

#include "floatframe/fe/shell_triangle.hpp"
#include "floatframe/fe/solid_shapes.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// A triangle; of those of a cell with two divisions each counts half.
struct Part {
  std::array<int, 3> nodes;
  double weight;
  int cell, division;
};
constexpr Part triangle[] = {{{0, 1, 2}, 1.0, 0, 0}};
constexpr Part quadrilateral[] = {
    {{0, 1, 2}, 0.5, 0, 0}, {{0, 2, 3}, 0.5, 0, 0}, {{0, 1, 3}, 0.5, 0, 1}, {{1, 2, 3}, 0.5, 0, 1}};
constexpr Part triangle6[] = {
    {{0, 3, 5}, 1.0, 0, 0}, {{3, 1, 4}, 1.0, 1, 0}, {{5, 4, 2}, 1.0, 2, 0}, {{3, 4, 5}, 1.0, 3, 0}};
/// Both divisions of the four cells round the middle, node 8.
constexpr std::array<Part, 16> quadrilaterals() {
  constexpr std::array<std::array<int, 4>, 4> cells{
      {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}};
  std::array<Part, 16> all{};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& n = quadrilateral[k].nodes;
      all[4 * c + k] = {{cells[c][n[0]], cells[c][n[1]], cells[c][n[2]]},
                        0.5,
                        static_cast<int>(c),
                        quadrilateral[k].division};
    }
  return all;
}
constexpr std::array<Part, 16> quadrilateral8 = quadrilaterals();
constexpr int most_cells = 4;

template <int nodes>
std::span<const Part> parts() {
  if constexpr (nodes == 3) return triangle;
  if constexpr (nodes == 6) return triangle6;
  if constexpr (nodes == 8) return quadrilateral8;
  return quadrilateral;
}

/// With the node in the middle of quad8.
template <int nodes>
constexpr int all_nodes = nodes == 8 ? 9 : nodes;

/// Weights of the nodes in the middle.
constexpr double middle_share(int node) { return node < 4 ? -0.25 : 0.5; }

template <int nodes>
ElementInput complete(ElementInput in) {
  if constexpr (nodes == 8) {
    in.p[8].setZero();
    for (int a = 0; a < 8; ++a) in.p[8] += middle_share(a) * in.p[a];
  }
  return in;
}

std::array<Vec3, 3> corners(const ElementInput& in, const Part& part) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = in.p[part.nodes[i]];
  return p;
}

/// Those of a triangle.
ShellLayers layers_at(const ShellLayers& layers, const ElementInput& in, const Part& part) {
  ShellLayers out = layers;
  for (unsigned i = 0; i < 3; ++i)
    out.own_drilling |= ((in.own_drilling >> part.nodes[i]) & 1u) << i;
  return out;
}

template <int nodes>
std::string error(const ElementInput& given) {
  const ElementInput in = complete<nodes>(given);
  if (!(in.shell.thickness > 0.0) || !std::isfinite(in.shell.thickness)) {
    return "has a thickness that is not positive";
  }
  if (!(in.shell.shear >= 0.0) || !std::isfinite(in.shell.shear)) {
    return "has a shear stiffness that is negative or no number";
  }
  if (in.layers && in.layers->axis.isZero(0.0))
    return "lies across the first axis of its material, which must have a direction in it";
  double size = 0.0;
  for (std::size_t a = 1; a < nodes; ++a) size = std::max(size, (in.p[a] - in.p[0]).norm());
  const Vec3 n = shell_normal({in.p.data(), nodes});
  for (const Part& part : parts<nodes>()) {
    const std::array<Vec3, 3> p = corners(in, part);
    const double twice = (p[1] - p[0]).cross(p[2] - p[0]).dot(n);
    // Thinner than 1e-9 of its size it is flat to the precision of its coordinates.
    if (!(twice > 1e-9 * size * size)) {
      if (nodes > 4) return "is folded, or its nodes are in the wrong order";
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

/// Of all nodes.
template <int nodes>
MatX whole_stiffness(const ElementInput& in) {
  MatX out = MatX::Zero(6 * all_nodes<nodes>, 6 * all_nodes<nodes>);
  const ShellLayers layers = layers_of(in);
  for (const Part& part : parts<nodes>()) {
    const Mat18 K = shell_triangle_stiffness(corners(in, part), layers_at(layers, in, part));
    for_blocks<nodes>(part, [&](int a, int b, int i, int j) {
      out.block<6, 6>(6 * a, 6 * b) += part.weight * K.block<6, 6>(6 * i, 6 * j);
    });
  }
  return out;
}

/// Displacements of the nodes of quad8 and its middle: it follows without load.
MatX motion(const MatX& K) {
  MatX G = MatX::Identity(54, 48);
  G.bottomRows<6>() = -ldlt_solve(K.block<6, 6>(48, 48), K.block<6, 48>(48, 0));
  return G;
}

/// For an element with independent rotations about the normal: its motion from that of its
/// nodes. With this rotation v at one node the energy is least where v^T K (u + v x) = 0.
template <int nodes>
MatX with_own_drilling(const ElementInput& in, MatX K) {
  MatX P = MatX::Identity(6 * nodes, 6 * nodes);
  const Vec3 n = shell_normal({in.p.data(), nodes});
  for (int a = 0; a < nodes; ++a) {
    if (((in.own_drilling >> a) & 1u) == 0) continue;
    VecX v = VecX::Zero(6 * nodes);
    v.segment<3>(6 * a + 3) = n;
    const VecX Kv = K * v;
    const double k = v.dot(Kv);
    if (!(k > 0.0)) continue;
    P -= ((P * v) * (Kv / k).transpose()).eval();
    K -= (Kv * (Kv / k).transpose()).eval();
  }
  return P;
}

/// Does the motion of the element differ from its nodes (middle node or independent rotations)?
template <int nodes>
bool follows(const ElementInput& in) {
  return nodes == 8 || in.own_drilling != 0;
}

/// All nodes from those of the element; K: of all nodes.
template <int nodes>
MatX motion_of_all(const ElementInput& in, const MatX& K) {
  const MatX G = nodes == 8 ? motion(K) : MatX::Identity(6 * nodes, 6 * nodes);
  if (in.own_drilling == 0) return G;
  return G * with_own_drilling<nodes>(in, G.transpose() * K * G);
}

/// Empty if the element moves as its nodes do.
template <int nodes>
MatX following(const ElementInput& in) {
  if (!follows<nodes>(in)) return {};
  return motion_of_all<nodes>(in, whole_stiffness<nodes>(in));
}

/// From all nodes to those of the element.
void condense(const MatX& G, MatX& matrix) {
  if (G.size() > 0) matrix = (matrix * G).eval();
}

template <int nodes>
void stiffness(const ElementInput& given, MatX& out) {
  const ElementInput in = complete<nodes>(given);
  out = whole_stiffness<nodes>(in);
  if (!follows<nodes>(in)) return;
  const MatX G = motion_of_all<nodes>(in, out);
  const MatX KG = out * G;
  out = in.own_drilling == 0 ? MatX(KG.topRows<6 * nodes>()) : MatX(G.transpose() * KG);
  out = (0.5 * (out + out.transpose())).eval();
}

template <int nodes>
void mass(const ElementInput& given, bool section_inertia, MatX& out) {
  const ElementInput in = complete<nodes>(given);
  out = MatX::Zero(6 * all_nodes<nodes>, 6 * all_nodes<nodes>);
  const ShellLayers layers = layers_of(in);
  for (const Part& part : parts<nodes>()) {
    const Mat18 M = shell_triangle_mass(corners(in, part), layers, section_inertia);
    for_blocks<nodes>(part, [&](int a, int b, int i, int j) {
      out.block<6, 6>(6 * a, 6 * b) += part.weight * M.block<6, 6>(6 * i, 6 * j);
    });
  }
  if constexpr (nodes == 8) {
    MatX G = MatX::Identity(54, 48);
    for (int a = 0; a < 8; ++a) G.block<6, 6>(48, 6 * a).diagonal().setConstant(middle_share(a));
    out = (G.transpose() * out * G).eval();
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
void stressed_points(const ElementInput& given, std::vector<StressedPoint>& points) {
  const ElementInput in = complete<nodes>(given);
  points.resize(parts<nodes>().size());
  const MatX G = following<nodes>(in);
  const ShellLayers layers = layers_of(in);
  std::size_t q = 0;
  for (const Part& part : parts<nodes>()) {
    const std::array<Vec3, 3> p = corners(in, part);
    const double area = triangle_area(p);
    const Mat3 R = triangle_axes(p);
    const auto N = shell_triangle_membrane(p, layers_at(layers, in, part));
    const Eigen::Matrix<double, 6, 18> stress = part.weight * area * from_triangle_axes(R) * N;
    StressedPoint& point = points[q++];
    point.stress = MatX::Zero(6, 6 * all_nodes<nodes>);
    point.gradient = MatX::Zero(9, 6 * all_nodes<nodes>);
    for (int a = 0; a < 3; ++a) {
      const int to = 6 * part.nodes[a];
      point.stress.middleCols<6>(to) = stress.middleCols<6>(6 * a);
      const Vec3 side = p[(a + 2) % 3] - p[(a + 1) % 3];
      const Vec3 g = R.col(2).cross(side) / (2.0 * area);
      // At the middle of the thickness: u + theta x offset n.
      const Mat3 arm = -layers.offset * skew(R.col(2));
      for (int i = 0; i < 3; ++i) {
        point.gradient.block<3, 1>(3 * i, to + i) = g;
        if (layers.offset != 0.0) point.gradient.block<3, 3>(3 * i, to + 3) = g * arm.row(i);
      }
    }
    condense(G, point.stress);
    condense(G, point.gradient);
  }
}

/// At a node: the mean of the cells there; for a quadrilateral the mean of its two divisions, of
/// which one has two triangles there.
template <int nodes>
void layer_stresses(const ElementInput& given, MatX& out) {
  const ElementInput in = complete<nodes>(given);
  out = MatX::Zero(12 * nodes, 6 * all_nodes<nodes>);
  const ShellLayers layers = layers_of(in);
  for (int a = 0; a < nodes; ++a) {
    std::array<std::array<int, 2>, most_cells> count{};  // of the triangles of each division here
    const auto corner_of = [&](const Part& part) {
      for (int i = 0; i < 3; ++i)
        if (part.nodes[i] == a) return i;
      return -1;
    };
    const std::span<const Part> all = parts<nodes>();
    for (const Part& part : all) count[part.cell][part.division] += corner_of(part) >= 0;
    const auto cells =
        std::count_if(count.begin(), count.end(), [](const auto& c) { return c[0] + c[1] > 0; });
    for (const Part& part : all) {
      const int corner = corner_of(part);
      if (corner < 0) continue;
      const auto S = shell_triangle_stress(corners(in, part), layers_at(layers, in, part), corner);
      const double share =
          part.weight / count[part.cell][part.division] / static_cast<double>(cells);
      for (int i = 0; i < 3; ++i)
        out.block<12, 6>(12 * a, 6 * part.nodes[i]) += share * S.middleCols<6>(6 * i);
    }
  }
  condense(following<nodes>(in), out);
}

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

constinit const ElementKernel tri3_kernel = shell_kernel<3>(shape::tri3_faces);
constinit const ElementKernel quad4_kernel = shell_kernel<4>(shape::quad4_faces);
constinit const ElementKernel tri6_kernel = shell_kernel<6>(shape::tri6_faces);
constinit const ElementKernel quad8_kernel = shell_kernel<8>(shape::quad8_faces);

}  // namespace floatframe
