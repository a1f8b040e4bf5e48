#pragma once
// Shares of a face's area that its nodes have where a force is spread over it: in proportion to the
// diagonal of int N N^T dA, which is positive at the corners of quadratic faces too.
#include <span>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Of the nodes of a triangle or quadrilateral, corners first, mid-side nodes after them or none;
/// their sum is the area. Quadrilaterals as parallelograms of the same diagonals.
std::vector<double> face_weights(std::span<const Vec3> corners, std::size_t nodes);

}  // namespace floatframe
