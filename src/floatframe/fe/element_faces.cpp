#include "floatframe/fe/element_faces.hpp"

namespace floatframe {
namespace {

using Edge = std::array<int, 2>;
using Corners = std::array<int, 4>;  // -1: a triangle

constexpr std::array<Edge, 6> tet_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 12> hex_edges{{{0, 1},
                                          {1, 2},
                                          {2, 3},
                                          {3, 0},
                                          {4, 5},
                                          {5, 6},
                                          {6, 7},
                                          {7, 4},
                                          {0, 4},
                                          {1, 5},
                                          {2, 6},
                                          {3, 7}}};
constexpr std::array<Edge, 9> wedge_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

constexpr std::array<Corners, 4> tet_corners{
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}};
constexpr std::array<Corners, 6> hex_corners{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
constexpr std::array<Corners, 5> wedge_corners{
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<Corners, 2> tri_corners{{{0, 1, 2, -1}, {0, 2, 1, -1}}};
constexpr std::array<Corners, 2> quad_corners{{{0, 1, 2, 3}, {0, 3, 2, 1}}};

/// Faces with the nodes in the middle of their edges, which follow the `corners` of the element.
template <std::size_t faces, std::size_t edges>
constexpr std::array<FaceNodes, faces> quadratic(const std::array<Corners, faces>& corners,
                                                 const std::array<Edge, edges>& edge_list,
                                                 int element_corners) {
  std::array<FaceNodes, faces> result{};
  for (std::size_t f = 0; f < faces; ++f) {
    FaceNodes& face = result[f];
    face.corners = corners[f][3] < 0 ? 3 : 4;
    for (int k = 0; k < face.corners; ++k) {
      face.nodes[face.count++] = corners[f][k];
    }
    for (int k = 0; k < face.corners; ++k) {
      const int a = face.nodes[k], b = face.nodes[(k + 1) % face.corners];
      for (std::size_t e = 0; e < edges; ++e) {
        if ((edge_list[e][0] == a && edge_list[e][1] == b) ||
            (edge_list[e][0] == b && edge_list[e][1] == a)) {
          face.nodes[face.count++] = element_corners + static_cast<int>(e);
        }
      }
    }
  }
  return result;
}

template <std::size_t faces>
constexpr std::array<FaceNodes, faces> linear(const std::array<Corners, faces>& corners) {
  return quadratic(corners, std::array<Edge, 0>{}, 0);
}

constexpr auto tet4 = linear(tet_corners);
constexpr auto tet10 = quadratic(tet_corners, tet_edges, 4);
constexpr auto hex8 = linear(hex_corners);
constexpr auto hex20 = quadratic(hex_corners, hex_edges, 8);
constexpr auto wedge6 = linear(wedge_corners);
constexpr auto wedge15 = quadratic(wedge_corners, wedge_edges, 6);
constexpr auto tri3 = linear(tri_corners);
constexpr auto quad4 = linear(quad_corners);

}  // namespace

std::span<const FaceNodes> element_faces(ElementType type) noexcept {
  switch (type) {
    case ElementType::tet4:
      return tet4;
    case ElementType::tet10:
      return tet10;
    case ElementType::hex8:
    case ElementType::hex8i:
    case ElementType::hex8r:
      return hex8;
    case ElementType::hex20:
    case ElementType::hex20r:
      return hex20;
    case ElementType::wedge6:
      return wedge6;
    case ElementType::wedge15:
      return wedge15;
    case ElementType::tri3:
      return tri3;
    case ElementType::quad4:
      return quad4;
    case ElementType::beam2:
    case ElementType::beam3:
      break;
  }
  return {};
}

int element_nodes(ElementType type) noexcept {
  switch (type) {
    case ElementType::beam2:
      return 2;
    case ElementType::beam3:
    case ElementType::tri3:
      return 3;
    case ElementType::quad4:
    case ElementType::tet4:
      return 4;
    case ElementType::wedge6:
      return 6;
    case ElementType::hex8:
    case ElementType::hex8i:
    case ElementType::hex8r:
      return 8;
    case ElementType::tet10:
      return 10;
    case ElementType::wedge15:
      return 15;
    case ElementType::hex20:
    case ElementType::hex20r:
      return 20;
  }
  return 0;
}

}  // namespace floatframe
