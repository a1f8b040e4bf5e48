#pragma once
// What a road is beside its profile: heights over x and y, which are added, and its friction. A
// patch is a rectangle along x and y with a friction of its own; of several the last one counts.
#include <memory>
#include <vector>

#include "floatframe/formulas/formula.hpp"
#include "floatframe/roads/crg_road.hpp"
#include "floatframe/roads/height_grid.hpp"
#include "floatframe/roads/surface_point.hpp"
#include "floatframe/roads/two_tracks.hpp"

namespace floatframe {

struct FrictionPatch {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< [m]
  double friction = 1.0;                          ///< factor, in place of that of the road
};

struct RoadSurface {
  SharedFormula height;  ///< of x and y [m]
  std::shared_ptr<const HeightGrid> grid;
  std::shared_ptr<const CrgRoad> crg;
  std::shared_ptr<const TwoTracks> tracks;
  double friction = 1.0;  ///< factor of the friction that a tyre has
  std::vector<FrictionPatch> patches;
  /// It has heights over x and y.
  bool wide() const noexcept { return height || grid || crg || tracks; }
};

/// Adds the heights and sets the friction. Step time.
void add_surface(const RoadSurface& surface, double x, double y, SurfacePoint& out) noexcept;

}  // namespace floatframe
