#pragma once
// What constraints along a curve share: their points, from the point of `from` along the axes of
// the world as drawn. Load time only.
#include <fmt/format.h>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

/// Neighbours are apart, those of a closed curve in a ring.
inline void validate_curve_points(const ElementCheck& check, const MatX& points, bool closed) {
  const Eigen::Index n = points.rows(), least = closed ? 3 : 2;
  if (n < least)
    return check.error(ErrorCode::wrong_count, "points",
                       fmt::format("found {}, expected at least {} points [x, y, z]",
                                   n == 1 ? "1 point" : "2 points", least));
  for (Eigen::Index i = closed ? 0 : 1; i < n; ++i)
    if ((points.row(i) - points.row(i > 0 ? i - 1 : n - 1)).norm() < 1e-9)
      return check.error(
          ErrorCode::geometry, "points",
          fmt::format("found row {} at the point before it, expected points apart", i + 1));
}

/// A constraint whose travel along its points is a length.
inline bool has_path(const ElementKeys& keys) {
  const PointOnCurve* curve = std::get_if<PointOnCurve>(&keys);
  return std::holds_alternative<SlideAlong>(keys) || (curve && curve->points.rows() > 0);
}

/// In the mirrored subsystem.
inline void mirror_curve_points(MatX& points, const Placement& x) {
  for (int k = 0; k < 3; ++k)
    if (points.rows() > 0 && x.P(k, k) < 0.0) points.col(k) *= -1.0;
}

}  // namespace floatframe
