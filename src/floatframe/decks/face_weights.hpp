#pragma once
// Fractions of a face's area for its nodes when a force is spread over it: in proportion to the
// diagonal of int N N^T dA, which is positive at the corners of quadratic faces too.
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Weights of the nodes of a triangle or quadrilateral, corners first, then mid-side nodes if any;
/// their sum is the area. Quadrilaterals as parallelograms of the same diagonals.
inline std::vector<double> face_weights(std::span<const Vec3> p, std::size_t nodes) {
  const bool triangle = p.size() == 3;
  const double area = triangle ? 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm()
                               : 0.5 * (p[2] - p[0]).cross(p[3] - p[1]).norm();
  const double each = 1.0 / static_cast<double>(p.size());
  const double quadratic = triangle ? 1.0 / 19.0 : 3.0 / 76.0;
  const double corner = nodes == p.size() ? each : quadratic;
  std::vector<double> out(nodes, area * (each - corner));
  for (std::size_t k = 0; k < p.size(); ++k) out[k] = area * corner;
  return out;
}

}  // namespace floatframe
