#pragma once
// A road of two tracks, z_l(x) along y = c + w/2 and z_r(x) along y = c - w/2. With t = (y - c)/w +
// 1/2, from 0 on the right track to 1 on the left one,
//   z = z_r + (3 t^2 - 2 t^3) (z_l - z_r)                                                   (1)
// between them; beyond, each track goes on level. So wheels on the tracks stand level across, and
// the slope does not jump.
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/roads/surface_point.hpp"

namespace floatframe {

struct TwoTracks {
  PiecewisePolynomial left, right;  ///< heights over x [m]
  double width = 1.5;               ///< w, between the tracks [m]
  double centre = 0.0;              ///< c [m]
};

/// Step time.
SurfacePoint tracks_height(const TwoTracks& tracks, double x, double y) noexcept;

}  // namespace floatframe
