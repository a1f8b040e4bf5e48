#pragma once
// The obstacle avoidance manoeuvre of ISO 3888-2: a double lane change through the gates of
// lane_gates.hpp, with the drive released 2 m after the entry.
// The path is that of lane_path.hpp.
#include <array>

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

}  // namespace floatframe
