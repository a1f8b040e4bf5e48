// Flat thin shells with six dofs a node: tri3 is one triangle (shell_triangle.hpp), quad4 the mean
// of its two divisions into triangles, which also serves quadrilaterals that are not flat.
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
std::string fault(const ElementInput& in) {
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

}  // namespace

const ElementKernel tri3_kernel{ElementType::tri3, "tri3",        3,        6,
                                &fault<3>,         &stiffness<3>, &mass<3>, &scalar_mass<3>};
const ElementKernel quad4_kernel{ElementType::quad4, "quad4",       4,        6,
                                 &fault<4>,          &stiffness<4>, &mass<4>, &scalar_mass<4>};

}  // namespace floatframe
