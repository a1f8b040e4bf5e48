#pragma once
// Velocity, acceleration or small displacement of a marker.
#include "floatframe/math/types.hpp"

namespace floatframe {

/// World axes: of the marker's point, and of its frame.
struct PointMotion {
  Vec3 linear, angular;
};

}  // namespace floatframe
