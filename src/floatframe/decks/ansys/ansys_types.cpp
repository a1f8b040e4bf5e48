#include <algorithm>
#include <set>

#include "floatframe/decks/ansys/ansys_content.hpp"

namespace floatframe {
namespace {

using F = AnsysFamily;
using T = FeElementType;

constexpr AnsysLibraryElement ansys_library[] = {
    {4, "BEAM4", F::beam2, 2},        {8, "LINK8", F::rod, 2},
    {14, "COMBIN14", F::spring, 2},   {21, "MASS21", F::mass, 1},
    {27, "MATRIX27", F::matrix, 2},   {45, "SOLID45", F::brick, 8},
    {63, "SHELL63", F::shell, 4},     {92, "SOLID92", F::tet, 10},
    {93, "SHELL93", F::shell, 8},     {95, "SOLID95", F::brick20, 20},
    {154, "SURF154", F::ignored, 9},  {169, "TARGE169", F::target, 9},
    {170, "TARGE170", F::target, 9},  {171, "CONTA171", F::contact, 9},
    {172, "CONTA172", F::contact, 9}, {173, "CONTA173", F::contact, 9},
    {174, "CONTA174", F::contact, 9}, {175, "CONTA175", F::contact, 9},
    {176, "CONTA176", F::contact, 9}, {177, "CONTA177", F::contact, 9},
    {178, "CONTA178", F::contact, 9}, {180, "LINK180", F::rod, 2},
    {181, "SHELL181", F::shell, 4},   {184, "MPC184", F::rigid, 3},
    {185, "SOLID185", F::brick, 8},   {186, "SOLID186", F::brick20, 20},
    {187, "SOLID187", F::tet, 10},    {188, "BEAM188", F::beam2, 2},
    {189, "BEAM189", F::beam3, 3},    {190, "SOLSH190", F::brick, 8},
    {200, "MESH200", F::ignored, 20}, {201, "FOLLW201", F::ignored, 1},
    {281, "SHELL281", F::shell, 8},   {285, "SOLID285", F::tet, 4},
    {288, "PIPE288", F::beam2, 2},    {289, "PIPE289", F::beam3, 3},
};

/// A degenerate shape of a brick or shell with repeated nodes: positions of the corners, then
/// those of the nodes on the edges.
struct Folded {
  T linear, quadratic;
  int corners, edges;
  std::array<int, 8> corner;
  std::array<int, 12> edge;
};

constexpr Folded folded_brick[] = {
    {T::hex8,
     T::hex20,
     8,
     12,
     {0, 1, 2, 3, 4, 5, 6, 7},
     {8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}},
    {T::wedge6, T::wedge15, 6, 9, {0, 1, 2, 4, 5, 6}, {8, 9, 11, 12, 13, 15, 16, 17, 18}},
    {T::pyramid5, T::pyramid13, 5, 8, {0, 1, 2, 3, 4}, {8, 9, 10, 11, 16, 17, 18, 19}},
    {T::tet4, T::tet10, 4, 6, {0, 1, 2, 4}, {8, 9, 11, 16, 17, 18}},
};
constexpr Folded folded_shell[] = {
    {T::quad4, T::quad8, 4, 4, {0, 1, 2, 3}, {4, 5, 6, 7}},
    {T::tri3, T::tri6, 3, 3, {0, 1, 2}, {4, 5, 7}},
};
constexpr Folded plain_tet{T::tet4, T::tet10, 4, 6, {0, 1, 2, 3}, {4, 5, 6, 7, 8, 9}};

const Folded& folded(F family, std::span<const int> n) {
  if (family == F::tet) return plain_tet;
  const bool triangle = n[2] == n[3];
  if (family == F::shell) return folded_shell[triangle ? 1 : 0];
  const bool apex = n[4] == n[5] && n[5] == n[6] && n[6] == n[7];
  if (apex) return folded_brick[triangle ? 3 : 2];
  return folded_brick[triangle && n[6] == n[7] ? 1 : 0];
}

/// Bricks by the options of their type.
T brick_type(const AnsysType& type, bool quadratic) {
  const auto& k = type.keyopt;
  switch (type.number) {
    case 45:
      return k[2] == 1 ? T::hex8r : k[1] == 1 ? T::hex8 : T::hex8i;
    case 185:
      return k[2] == 0 ? T::hex8 : k[2] == 1 ? T::hex8r : T::hex8i;
    case 190:
      return T::hex8i;
    case 95:
      if (!quadratic) return T::hex8i;
      return k[11] == 1 ? T::hex20r : T::hex20;
    default:  // 186; without mid-side nodes its shape functions are those of the brick of 8
      return quadratic ? (k[2] == 1 ? T::hex20 : T::hex20r) : T::hex8;
  }
}

}  // namespace

const AnsysLibraryElement* ansys_library_element(int number) noexcept {
  const auto* it = std::find_if(std::begin(ansys_library), std::end(ansys_library),
                                [number](const auto& e) { return e.number == number; });
  return it == std::end(ansys_library) ? nullptr : it;
}

std::optional<AnsysShape> ansys_shape(const AnsysLibraryElement& element, const AnsysType& type,
                                      std::span<const int> nodes) {
  const int corners = element.family == F::tet || element.family == F::shell ? 4 : 8;
  std::array<int, 20> n{};
  std::copy_n(nodes.begin(), std::min<std::size_t>(nodes.size(), n.size()), n.begin());
  // A triangle, a tetrahedron may be listed without the repetitions.
  if (corners == 4 && n[3] == 0 && element.family == F::shell) n[3] = n[2];
  if (std::find(n.begin(), n.begin() + corners, 0) != n.begin() + corners) return std::nullopt;
  const Folded& f = folded(element.family, n);
  AnsysShape shape;
  std::set<int> seen;
  for (int k = 0; k < f.corners; ++k) {
    shape.nodes[k] = n[f.corner[k]];
    if (!seen.insert(shape.nodes[k]).second) return std::nullopt;
  }
  bool quadratic = false;
  const bool may = element.nodes > corners;
  for (int k = 0; k < f.edges && may; ++k) {
    const int node = n[f.edge[k]];
    shape.nodes[f.corners + k] = node;
    quadratic = quadratic || node != 0;
    if (node != 0 && !seen.insert(node).second) return std::nullopt;
  }
  shape.type = quadratic ? f.quadratic : f.linear;
  shape.count = f.corners + (quadratic ? f.edges : 0);
  if (f.linear == T::hex8) shape.type = brick_type(type, quadratic);
  return shape;
}

}  // namespace floatframe
