#pragma once
// What tests of solids with axes and with plies share: a material of fibres, the places of nodes
// in one element, strips of bricks one above another.
#include <iterator>
#include <vector>

#include "floatframe/fe/elasticity.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {

inline constexpr EngineeringConstants fibres{.E1 = 1.4e11,
                                             .E2 = 1e10,
                                             .E3 = 8e9,
                                             .nu12 = 0.3,
                                             .nu13 = 0.25,
                                             .nu23 = 0.4,
                                             .G12 = 5e9,
                                             .G13 = 4e9,
                                             .G23 = 3e9};
inline constexpr double fibres_density = 1600.0;

inline bool is_wedge(FeElementType type) {
  return type == FeElementType::wedge6 || type == FeElementType::wedge15;
}

/// Nodes on edges in their middles; the corners of bricks, wedges and tetrahedra come first.
template <typename Places>
void set_middles(const ElementKernel& kernel, Places& p) {
  for (const FaceNodes& face : kernel.shape.faces)
    for (int i = face.corners; i < face.count; ++i)
      p[face.nodes[i]] = 0.5 * (p[face.nodes[i - face.corners]] +
                                p[face.nodes[(i - face.corners + 1) % face.corners]]);
}

/// Natural coordinates of the corners.
inline std::vector<Vec3> natural_corners(FeElementType type) {
  const Vec3 brick[8] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                         {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const Vec3 wedge[6] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const Vec3 tet[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int nodes = element_kernel(type).nodes;
  if (is_wedge(type)) return {std::begin(wedge), std::end(wedge)};
  if (nodes == 4 || nodes == 10) return {std::begin(tet), std::end(tet)};
  return {std::begin(brick), std::end(brick)};
}

/// Natural coordinates of the nodes.
inline std::vector<Vec3> natural_nodes(FeElementType type) {
  std::vector<Vec3> out = natural_corners(type);
  out.resize(element_kernel(type).nodes, Vec3::Zero());
  set_middles(element_kernel(type), out);
  return out;
}

/// nx bricks along x in each of the layers between the heights z, of which element e is in layer
/// e % (number of layers).
inline FeModel brick_strip(int nx, double length, double width, const std::vector<double>& z) {
  const int rows = static_cast<int>(z.size());
  FeModel model = brick_beam(nx, 1, rows - 1, length, width);
  for (int k = 0; k < model.nodes(); ++k) model.positions[k](2) = z[k % rows];
  return model;
}

}  // namespace floatframe::test
