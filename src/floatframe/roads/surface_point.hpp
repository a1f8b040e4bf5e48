#pragma once
// What is known of a road surface z(x, y) at one place.

namespace floatframe {

/// Height [m], slopes [-] and second derivatives [1/m] along x and y, and the factor of friction.
struct SurfacePoint {
  double z = 0.0, zx = 0.0, zy = 0.0;
  double zxx = 0.0, zxy = 0.0, zyy = 0.0;
  double friction = 1.0;
};

}  // namespace floatframe
