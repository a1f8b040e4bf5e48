#include "floatframe/vehicle/flat_road.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/road.hpp"

namespace floatframe {
namespace {

/// The roads that the tyres name, each once.
std::set<std::string> roads_of_tyres(const ModelDescription& d) {
  std::set<std::string> out;
  for (const VehicleAxle& a : d.vehicle->axles)
    for (const VehicleWheel* w : {&a.left, &a.right}) {
      const auto tyre = std::ranges::find(d.forces, w->tyre, &ElementDescription::name);
      if (tyre == d.forces.end()) continue;
      for (const ElementKey& key : element_keys(tyre->type())) {
        if (key.kind != KeyKind::road) continue;
        if (const auto road = key_value(*tyre, key)) out.insert(std::get<std::string>(*road));
      }
    }
  return out;
}

struct RoadHeights {
  double low = 0.0, high = 0.0;  ///< [m]
};

/// Where there is no road, its height is not a number and counts nothing.
RoadHeights heights_of(const Road& road) {
  RoadHeights out;
  const auto look = [&](double x, double y) {
    const double z = surface_at(road, x, y).z;
    if (z < out.low) out.low = z;
    if (z > out.high) out.high = z;
  };
  const bool wide = road.surface && road.surface->wide();
  for (double x = -100.0; x <= 1000.0; x += 1.0) {
    look(x, 0.0);
    if (!wide) continue;
    for (const double y : {0.8, 4.0, 40.0, 250.0}) look(x, y), look(x, -y);
  }
  // Bumps and edges between the samples.
  for (const CosineBump& bump : road.bumps) look(bump.start + 0.5 * bump.length, 0.0);
  for (const double x : road.pieces.breaks()) look(x, 0.0);
  return out;
}

}  // namespace

void require_flat_roads(const ModelDescription& d, const std::string& manoeuvre, bool patches) {
  constexpr double flat = 1e-6;  // [m]
  for (const std::string& name : roads_of_tyres(d)) {
    const auto r = std::ranges::find(d.roads, name, &RoadDescription::name);
    if (r == d.roads.end()) continue;
    const std::string path = "roads." + name;
    const auto refuse = [&](const std::string& found) {
      throw InputError({{r->origin.mark, ErrorCode::wrong_value,
                         path + ": found " + found + " for " + manoeuvre, 1, path}});
    };
    const RoadHeights z = heights_of({r->name, r->pieces, r->bumps, r->surface});
    if (z.high > flat || z.low < -flat)
      refuse(fmt::format("heights between {:.4g} and {:.4g} m, expected a flat road at z = 0",
                         z.low, z.high));
    if (!patches && r->surface && !r->surface->patches.empty())
      refuse("patches of friction, expected a road of the same friction everywhere");
  }
}

}  // namespace floatframe
