#pragma once
// Shapes of solids, shells and membranes used by several kernels.
#include <numbers>

#include "floatframe/fe/element_shape.hpp"

namespace floatframe::shape {

// Tetrahedra.
inline constexpr std::array<Edge, 6> tet_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<Corners, 4> tet_corners{
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}};
inline constexpr Neighbours tet_neighbours[] = {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}};
inline constexpr auto tet4_faces = linear(tet_corners);
inline constexpr auto tet10_faces = quadratic(tet_corners, tet_edges, 4);
inline constexpr double tet_regular_corner = 0.5 * std::numbers::sqrt2;
inline constexpr ElementShape tet4{tet4_faces, tet_neighbours, tet_regular_corner};
inline constexpr ElementShape tet10{tet10_faces, tet_neighbours, tet_regular_corner};

// Bricks.
inline constexpr std::array<Edge, 12> hex_edges{{{0, 1},
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
inline constexpr std::array<Corners, 6> hex_corners{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
inline constexpr Neighbours hex_neighbours[] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                                {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
inline constexpr auto hex8_faces = linear(hex_corners);
inline constexpr auto hex20_faces = quadratic(hex_corners, hex_edges, 8);
inline constexpr ElementShape hex8{hex8_faces, hex_neighbours};
inline constexpr ElementShape hex20{hex20_faces, hex_neighbours};

// Wedges.
inline constexpr std::array<Edge, 9> wedge_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
inline constexpr std::array<Corners, 5> wedge_corners{
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
inline constexpr Neighbours wedge_neighbours[] = {{1, 2, 3}, {2, 0, 4}, {0, 1, 5},
                                                  {5, 4, 0}, {3, 5, 1}, {4, 3, 2}};
inline constexpr auto wedge6_faces = linear(wedge_corners);
inline constexpr auto wedge15_faces = quadratic(wedge_corners, wedge_edges, 6);
inline constexpr double wedge_regular_corner = 0.5 * std::numbers::sqrt3;
inline constexpr ElementShape wedge6{wedge6_faces, wedge_neighbours, wedge_regular_corner};
inline constexpr ElementShape wedge15{wedge15_faces, wedge_neighbours, wedge_regular_corner};

// Pyramids; of the four edges at the apex three are checked.
inline constexpr std::array<Edge, 8> pyramid_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
inline constexpr std::array<Corners, 5> pyramid_corners{
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
inline constexpr Neighbours pyramid_neighbours[] = {
    {1, 3, 4}, {2, 0, 4}, {3, 1, 4}, {0, 2, 4}, {2, 1, 0}};
inline constexpr auto pyramid5_faces = linear(pyramid_corners);
inline constexpr auto pyramid13_faces = quadratic(pyramid_corners, pyramid_edges, 5);
inline constexpr double pyramid_regular_corner = 0.5 * std::numbers::sqrt2;
inline constexpr ElementShape pyramid5{pyramid5_faces, pyramid_neighbours, pyramid_regular_corner};
inline constexpr ElementShape pyramid13{pyramid13_faces, pyramid_neighbours,
                                        pyramid_regular_corner};

// Shells and membranes: both sides.
inline constexpr std::array<Edge, 3> tri_edges{{{0, 1}, {1, 2}, {2, 0}}};
inline constexpr std::array<Edge, 4> quad_edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
inline constexpr std::array<Corners, 2> tri_corners{{{0, 1, 2, -1}, {0, 2, 1, -1}}};
inline constexpr std::array<Corners, 2> quad_corners{{{0, 1, 2, 3}, {0, 3, 2, 1}}};
inline constexpr auto tri3_faces = linear(tri_corners);
inline constexpr auto quad4_faces = linear(quad_corners);
inline constexpr auto tri6_faces = quadratic(tri_corners, tri_edges, 3);
inline constexpr auto quad8_faces = quadratic(quad_corners, quad_edges, 4);

}  // namespace floatframe::shape
