#pragma once
// The shape of an element, as in its kernel: faces, and the edges at each corner, by local node
// numbers. Faces are numbered from 0 in the order of Abaqus (S1, S2, ...). Seen from outside the
// corners run anticlockwise; then come the mid-side nodes, the first between the first two corners.
#include <array>
#include <cstddef>
#include <span>

namespace floatframe {

struct FaceNodes {
  int corners = 0;             ///< 3 or 4
  int count = 0;               ///< corners, and as many mid-side nodes of quadratic elements
  std::array<int, 8> nodes{};  ///< indices into Element::nodes
};

/// The three corners next to a corner, so that the edges to them form a right-handed triad.
using Neighbours = std::array<int, 3>;

struct ElementShape {
  /// Shells: 0 the side of the positive normal (SPOS), 1 the other (SNEG). Beams have none.
  std::span<const FaceNodes> faces = {};
  /// Of the corners of a solid, in their order.
  std::span<const Neighbours> neighbours = {};
  /// Determinant of the unit edges at a corner of the regular element.
  double regular_corner = 1.0;
};

namespace shape {

using Edge = std::array<int, 2>;
using Corners = std::array<int, 4>;  // -1: a triangle

/// Faces with the nodes in the middle of their edges, which follow the `corners` of the element.
template <std::size_t faces, std::size_t edges>
constexpr std::array<FaceNodes, faces> quadratic(const std::array<Corners, faces>& corners,
                                                 const std::array<Edge, edges>& edge_list,
                                                 int element_corners) {
  std::array<FaceNodes, faces> result{};
  for (std::size_t f = 0; f < faces; ++f) {
    FaceNodes& face = result[f];
    face.corners = corners[f][3] < 0 ? 3 : 4;
    for (int k = 0; k < face.corners; ++k) face.nodes[face.count++] = corners[f][k];
    for (int k = 0; k < face.corners; ++k) {
      const int a = face.nodes[k], b = face.nodes[(k + 1) % face.corners];
      for (std::size_t e = 0; e < edges; ++e)
        if ((edge_list[e][0] == a && edge_list[e][1] == b) ||
            (edge_list[e][0] == b && edge_list[e][1] == a))
          face.nodes[face.count++] = element_corners + static_cast<int>(e);
    }
  }
  return result;
}

template <std::size_t faces>
constexpr std::array<FaceNodes, faces> linear(const std::array<Corners, faces>& corners) {
  return quadratic(corners, std::array<Edge, 0>{}, 0);
}

}  // namespace shape
}  // namespace floatframe
