#include "floatframe/model/road.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace floatframe {

namespace {

RoadPoint with_bumps(const Road& road, const PiecewisePolynomial::Value& v, double x) noexcept {
  RoadPoint p{v.f, v.df, v.ddf};
  for (const CosineBump& bump : road.bumps) {
    assert(bump.length > 0.0);
    const double s = (x - bump.start) / bump.length;
    if (s <= 0.0 || s >= 1.0) continue;
    const double w = 2.0 * std::numbers::pi;
    const double sine = std::sin(w * s), cosine = std::cos(w * s), rate = w / bump.length;
    p.z += 0.5 * bump.height * (1.0 - cosine);
    p.slope += 0.5 * bump.height * rate * sine;
    p.curvature += 0.5 * bump.height * rate * rate * cosine;
  }
  return p;
}

}  // namespace

RoadPoint road_at(const Road& road, double x) noexcept {
  return with_bumps(road, road.pieces(x), x);
}

RoadPoint road_at(const Road& road, std::size_t stretch, double x) noexcept {
  return with_bumps(road, road.pieces.stretch_value(stretch, x), x);
}

SurfacePoint surface_at(const Road& road, double x, double y) noexcept {
  const RoadPoint p = road_at(road, x);
  SurfacePoint s;
  s.z = p.z;
  s.zx = p.slope;
  s.zxx = p.curvature;
  if (road.surface) add_surface(*road.surface, x, y, s);
  return s;
}

}  // namespace floatframe
