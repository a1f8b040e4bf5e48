#pragma once
// Roads: profiles over x, a piecewise polynomial plus cosine bumps, and surfaces that are added.
#include "floatframe/model/model.hpp"
#include "floatframe/roads/surface_point.hpp"

namespace floatframe {

/// Height [m], slope [-] and second derivative [1/m] of a road at x.
struct RoadPoint {
  double z = 0.0, slope = 0.0, curvature = 0.0;
};
RoadPoint road_at(const Road& road, double x) noexcept;
/// On one segment, also beyond its edges (PiecewisePolynomial).
RoadPoint road_at(const Road& road, std::size_t stretch, double x) noexcept;
/// The surface above (x, y), in world axes; that of a profile does not depend on y. Step time.
SurfacePoint surface_at(const Road& road, double x, double y) noexcept;

}  // namespace floatframe
