#pragma once
// What a curve must not have: gaps within its range, corners, places where it crosses itself. Load
// time only.
#include "floatframe/model/curve_gap.hpp"

namespace floatframe {

/// The first gap or end between its samples.
std::optional<CurveGap> curve_gap(const SpaceCurve& curve);

struct CurveCorners {
  std::size_t count = 0;
  double at = 0.0, angle = 0.0;  ///< of the largest one: u, and what the tangent turns by [rad]
};
CurveCorners curve_corners(const SpaceCurve& curve);

/// Two parameters at which it is in the same place, but for the sag of the chords of its samples.
struct CurveCrossing {
  double u = 0.0, w = 0.0;
};
std::optional<CurveCrossing> curve_crossing(const SpaceCurve& curve);

}  // namespace floatframe
