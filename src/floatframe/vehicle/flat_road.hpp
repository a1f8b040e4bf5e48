#pragma once
// Whether the roads under the tyres of a vehicle are what manoeuvres are driven on: flat, at z = 0,
// and everywhere of the same friction. Surfaces of any kind are asked for their heights, from 100 m
// behind the origin to 1 km ahead of it and 250 m to both sides, every metre along the middle and
// the wheels' tracks.
#include <string>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// Throws InputError at the first road that is not; `patches`: those of friction may be there. The
/// description is valid and has a vehicle.
void require_flat_roads(const ModelDescription& d, const std::string& manoeuvre, bool patches);

}  // namespace floatframe
