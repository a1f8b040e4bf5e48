#include <algorithm>

#include "floatframe/decks/unv/unv_content.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

using U = ElementType;

constexpr std::array<int, 20> as_in_unv = {0, 1, 2, 3, 4, 5, 6, 7};

constexpr std::array<int, 20> parabolic_triangle = {0, 2, 4, 1, 3, 5};
constexpr std::array<int, 20> parabolic_quadrilateral = {0, 2, 4, 6, 1, 3, 5, 7};

/// Parabolic elements go round each ring from corner to middle to corner.
const UnvType unv_types[] = {
    {11, "rod", 2, true, {}, {}},
    {21, "linear beam", 2, true, {}, {}},
    {22, "tapered beam", 0, true, {}, {}},
    {23, "curved beam", 0, true, {}, {}},
    {24, "parabolic beam", 3, true, {}, {}},
    {41, "plane stress triangle", 3, false, U::tri3, as_in_unv},
    {42, "parabolic plane stress triangle", 6, false, U::tri6, parabolic_triangle},
    {44, "plane stress quadrilateral", 4, false, U::quad4, as_in_unv},
    {45, "parabolic plane stress quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {51, "plane strain triangle", 3, false, {}, {}},
    {52, "parabolic plane strain triangle", 6, false, {}, {}},
    {54, "plane strain quadrilateral", 4, false, {}, {}},
    {55, "parabolic plane strain quadrilateral", 8, false, {}, {}},
    {61, "plate triangle", 3, false, U::tri3, as_in_unv},
    {62, "parabolic plate triangle", 6, false, U::tri6, parabolic_triangle},
    {64, "plate quadrilateral", 4, false, U::quad4, as_in_unv},
    {65, "parabolic plate quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {91, "thin shell triangle", 3, false, U::tri3, as_in_unv},
    {92, "parabolic thin shell triangle", 6, false, U::tri6, parabolic_triangle},
    {94, "thin shell quadrilateral", 4, false, U::quad4, as_in_unv},
    {95, "parabolic thin shell quadrilateral", 8, false, U::quad8, parabolic_quadrilateral},
    {111, "solid linear tetrahedron", 4, false, U::tet4, as_in_unv},
    {112, "solid linear wedge", 6, false, U::wedge6, as_in_unv},
    {113,
     "solid parabolic wedge",
     15,
     false,
     U::wedge15,
     {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}},
    {115, "solid linear brick", 8, false, U::hex8, as_in_unv},
    {116, "solid parabolic brick", 20, false, U::hex20, {0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                                         5, 7, 13, 15, 17, 19, 8,  9,  10, 11}},
    {118, "solid parabolic tetrahedron", 10, false, U::tet10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}},
    {121, "rigid bar", 2, false, {}, {}, UnvUse::rigid},
    {122, "rigid element", 0, false, {}, {}, UnvUse::rigid},
    {136, "translational spring", 2, false, {}, {}, UnvUse::refused},
    {137, "rotational spring", 2, false, {}, {}, UnvUse::refused},
    {138, "translational spring to the ground", 1, false, {}, {}, UnvUse::refused},
    {139, "rotational spring to the ground", 1, false, {}, {}, UnvUse::refused},
    {141, "damper", 2, false, {}, {}, UnvUse::left},
    {142, "damper to the ground", 1, false, {}, {}, UnvUse::left},
    {161, "lumped mass", 1, false, {}, {}, UnvUse::refused},
};

}  // namespace

bool UnvType::solid() const noexcept {
  return element && element_kernel(*element).family == ElementFamily::solid;
}

const UnvType* unv_type(int number) noexcept {
  const auto* it = std::find_if(std::begin(unv_types), std::end(unv_types),
                                [number](const UnvType& t) { return t.number == number; });
  return it == std::end(unv_types) ? nullptr : it;
}

}  // namespace floatframe
