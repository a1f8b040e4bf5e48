#pragma once
// The obstacle avoidance manoeuvre of ISO 3888-2: a double lane change through the gates of
// lane_gates.hpp, with the drive released 2 m after the entry.
//
// The path is the one with the least integral of y''^2 through the points below (a cubic spline
// with y' = 0 at the entry and y'' = 0 at the end); with the width b of the vehicle and m = 0.1 m,
// at most half of what is free on a side:
//   x = 0       y = 0
//   x = 12      left edge of section 1 - b/2 - m
//   x = 25.5    right edge of section 3 + b/2 + m
//   x = 36.5    the same
//   x = 49      left edge of section 5 - b/2 - m
//   x = 61      centre of section 5
#include <array>
#include <vector>

#include "floatframe/vehicle/lane_gates.hpp"
#include "floatframe/vehicle/vehicle_run.hpp"

namespace floatframe {

struct LaneChangeResult {
  double entry_speed = 0.0, exit_speed = 0.0;  ///< at x = 0 and x = 61 m [m/s]
  std::array<LaneGate, 3> gates;
  std::array<double, 3> clearance{};  ///< the smallest at each gate [m]; negative: cones fall
  double largest_lateral_acceleration = 0.0, largest_yaw_rate = 0.0;  ///< [m/s2], [rad/s]
  double largest_steering = 0.0, largest_sideslip = 0.0;              ///< [rad]
  bool passed = false;
};

/// Throws RunError if the vehicle does not reach the end within 30 s.
LaneChangeResult lane_change(VehicleRun& run, double speed);

/// The path in the axes of the track, from the entry to x = 61 m, for a vehicle of this width [m].
std::vector<PathPoint> lane_change_path(double width, double spacing = 0.1);

/// Second derivatives at the knots x of the cubic spline through (x, y) that has the slope zero at
/// its first knot and no curvature at its last. At least two knots, x ascending.
std::vector<double> spline_curvatures(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace floatframe
