#pragma once
// Faces of solid and shell elements, numbered from 0 in the order of Abaqus (S1, S2, ...). Seen
// from outside the corners run anticlockwise; then come the mid-side nodes, the first between the
// first two corners.
#include <array>
#include <span>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct FaceNodes {
  int corners = 0;             ///< 3 or 4
  int count = 0;               ///< corners, and as many mid-side nodes of quadratic elements
  std::array<int, 8> nodes{};  ///< indices into Element::nodes
};

/// Shells: 0 the side of the positive normal (SPOS), 1 the other (SNEG). Beams have none.
std::span<const FaceNodes> element_faces(ElementType type) noexcept;

/// Nodes of an element: 2 for beam2, ... 20 for hex20.
int element_nodes(ElementType type) noexcept;

}  // namespace floatframe
