#pragma once
// Axes of beams at their nodes.
#include <array>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Tangent of a beam at node k of `p`; with three nodes that of the quadratic shapes.
inline Vec3 beam_tangent(const std::array<Vec3, 3>& p, int nodes, int k) {
  if (nodes == 2) return p[1] - p[0];
  if (k == 0) return -1.5 * p[0] + 2.0 * p[1] - 0.5 * p[2];
  if (k == 2) return 0.5 * p[0] - 2.0 * p[1] + 1.5 * p[2];
  return 0.5 * (p[2] - p[0]);
}

/// Is the direction parallel to the axis, within the limit 1e-6 of beams? Not if a length is zero.
inline bool is_along_axis(const Vec3& tangent, const Vec3& direction) {
  const double size = tangent.stableNorm() * direction.stableNorm();
  return std::isfinite(size) && size > 0.0 && tangent.cross(direction).stableNorm() < 1e-6 * size;
}

}  // namespace floatframe
