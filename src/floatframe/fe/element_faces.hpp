#pragma once
// Faces and nodes of an element type, from its kernel (element_kernel.hpp).
#include <span>

#include "floatframe/fe/element_list.hpp"
#include "floatframe/fe/element_shape.hpp"

namespace floatframe {

std::span<const FaceNodes> element_faces(FeElementType type) noexcept;

/// Nodes of an element: 2 for beam2, ... 20 for hex20.
int element_nodes(FeElementType type) noexcept;

}  // namespace floatframe
