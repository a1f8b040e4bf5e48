#include "floatframe/formats/gmsh/gmsh_types.hpp"

#include <algorithm>
#include <string_view>

namespace floatframe {
namespace {

using E = ElementType;

constexpr std::array<int, 20> same_order = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                            10, 11, 12, 13, 14, 15, 16, 17, 18, 19};

const GmshType gmsh_types[] = {
    {1, "2-node line", 1, 2, {}, {}},
    {2, "3-node triangle", 2, 3, E::tri3, same_order},
    {3, "4-node quadrilateral", 2, 4, E::quad4, same_order},
    {4, "4-node tetrahedron", 3, 4, E::tet4, same_order},
    {5, "8-node hexahedron", 3, 8, E::hex8, same_order},
    {6, "6-node wedge", 3, 6, E::wedge6, same_order},
    {7, "5-node pyramid", 3, 5, E::pyramid5, same_order},
    {8, "3-node line", 1, 3, {}, {}},
    {9, "6-node triangle", 2, 6, E::tri6, same_order},
    {10, "9-node quadrilateral", 2, 9, {}, {}},
    {11, "10-node tetrahedron", 3, 10, E::tet10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {12, "27-node hexahedron", 3, 27, {}, {}},
    {13, "18-node wedge", 3, 18, {}, {}},
    {14, "14-node pyramid", 3, 14, {}, {}},
    {15, "point", 0, 1, {}, {}},
    {16, "8-node quadrilateral", 2, 8, E::quad8, same_order},
    {17, "20-node hexahedron", 3, 20, E::hex20, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    {18, "15-node wedge", 3, 15, E::wedge15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    {19, "13-node pyramid", 3, 13, E::pyramid13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
    {20, "9-node triangle", 2, 9, {}, {}},
    {21, "10-node triangle", 2, 10, {}, {}},
    {26, "4-node line", 1, 4, {}, {}},
    {27, "5-node line", 1, 5, {}, {}},
    {29, "20-node tetrahedron", 3, 20, {}, {}},
    {30, "35-node tetrahedron", 3, 35, {}, {}},
    {36, "16-node quadrilateral", 2, 16, {}, {}},
    {92, "64-node hexahedron", 3, 64, {}, {}},
};

}  // namespace

int surface_corners(const GmshType& type) noexcept {
  return std::string_view(type.name).ends_with("triangle") ? 3 : 4;
}

const GmshType* gmsh_type(int number) noexcept {
  const auto* it = std::find_if(std::begin(gmsh_types), std::end(gmsh_types),
                                [number](const GmshType& t) { return t.number == number; });
  return it == std::end(gmsh_types) ? nullptr : it;
}

}  // namespace floatframe
