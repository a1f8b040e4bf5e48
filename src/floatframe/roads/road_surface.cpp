#include "floatframe/roads/road_surface.hpp"

#include "floatframe/roads/height_formula.hpp"

namespace floatframe {
namespace {

void add_heights(const SurfacePoint& more, SurfacePoint& out) noexcept {
  out.z += more.z;
  out.zx += more.zx;
  out.zy += more.zy;
  out.zxx += more.zxx;
  out.zxy += more.zxy;
  out.zyy += more.zyy;
}

}  // namespace

void add_surface(const RoadSurface& surface, double x, double y, SurfacePoint& out) noexcept {
  if (surface.height) add_heights(formula_height(*surface.height, x, y), out);
  if (surface.grid) add_heights(grid_height(*surface.grid, x, y), out);
  if (surface.crg) add_heights(crg_surface(*surface.crg, x, y), out);
  if (surface.tracks) add_heights(tracks_height(*surface.tracks, x, y), out);
  out.friction = surface.friction;
  for (const FrictionPatch& p : surface.patches)
    if (x >= p.x0 && x <= p.x1 && y >= p.y0 && y <= p.y1) out.friction = p.friction;
}

}  // namespace floatframe
