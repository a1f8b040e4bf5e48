#pragma once
// A stop in a straight line: from the trimmed start the drive is released and the brakes are
// applied, with the steering held. Braking begins at time zero; its torque grows within `rise`.
//
// The mean fully developed deceleration of UN R13-H, annex 3, with v_0 at time zero,
// v_b = 0.8 v_0, v_e = 0.1 v_0 and the distances s_b, s_e driven until then:
//   d_m = (v_b^2 - v_e^2)/(2 (s_e - s_b))
// (there with km/h: divided by 25.92 in place of 2). The vehicle stands when its speed falls below
// 0.01 m/s.
#include "floatframe/vehicle/vehicle_run.hpp"

namespace floatframe {

struct StraightStopOptions {
  double speed = 80.0 / 3.6;  ///< [m/s]
  double torque = 0.0;        ///< of all brakes together, positive [N m]
  double rise = 0.2;          ///< until the torque is there, a quintic [s]
  double longest = 60.0;      ///< [s]
};

struct StraightStopResult {
  double speed = 0.0;         ///< at time zero [m/s]
  double torque = 0.0;        ///< asked for, within the limits of the input [N m]
  double distance = 0.0;      ///< driven until it stands [m]
  double duration = 0.0;      ///< until it stands [s]
  double deceleration = 0.0;  ///< mean fully developed, d_m [m/s2]
  double offset = 0.0;        ///< largest distance from the straight line [m]
  double turned = 0.0;        ///< largest change of the yaw angle [rad]
};

/// Throws RunError if the vehicle does not stand in time.
StraightStopResult straight_stop(VehicleRun& run, const StraightStopOptions& options);

}  // namespace floatframe
