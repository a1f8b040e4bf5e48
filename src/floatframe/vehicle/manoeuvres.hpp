#pragma once
// Manoeuvres on a flat road: a vehicle that starts trimmed (vehicle_run.hpp), is driven, and the
// figures of the standards. docs/vehicle.md has every formula.
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/vehicle/circle_figures.hpp"
#include "floatframe/vehicle/step_figures.hpp"
#include "floatframe/vehicle/vehicle_run.hpp"

namespace floatframe {

struct StepSteerOptions {
  double speed = 80.0 / 3.6;  ///< [m/s]
  double angle =
      std::numbers::pi / 180.0;  ///< road-wheel angle of the step [rad], positive: to the left
  /// Steady lateral acceleration that is asked for in place of the angle [m/s2], positive: to the
  /// left. The angle is found from the trimmed start in at most three runs: the first one with that
  /// of a neutral vehicle, a L/v^2, the others by secants, the first of them through zero.
  std::optional<double> lateral_acceleration = {};
  double begin = 1.0;     ///< of the steering, after the start [s]
  double ramp = 0.15;     ///< duration of the steering, a quintic [s]
  double duration = 5.0;  ///< after the start [s]
  double window = 0.5;    ///< at the end, of the steady values [s]
};

struct StepSteerResult {
  double speed = 0.0, end_speed = 0.0;  ///< at the start and at the end [m/s]
  double first_second_yaw_rate = 0.0;   ///< largest before the steering [rad/s]
  double first_second_drift = 0.0;      ///< change of the speed before the steering [m/s]
  double t_50 = 0.0;                    ///< [s]
  double steering = 0.0;                ///< change of the road-wheel angle [rad]
  std::optional<double> asked = {};     ///< lateral acceleration of the options [m/s2]
  int runs = 1;                         ///< that the angle took
  StepResponse yaw_rate, lateral_acceleration, sideslip, roll;  ///< [rad/s, m/s2, rad, rad]
  double tb = 0.0;                                              ///< TB [s deg]
  /// Largest change of the yaw rate within the window, of its steady value [1].
  double unsteadiness = 0.0;
};

/// How near a steady lateral acceleration that is asked for is found, of it.
inline constexpr double step_steer_miss = 0.01;

/// Steering angle fixed in time, drive force held at that of the trimmed start: ISO 7401.
StepSteerResult step_steer(VehicleRun& run, const StepSteerOptions& options);

struct SteadyCircleOptions {
  double speed = 80.0 / 3.6;  ///< of the last point [m/s]
  double radius = 100.0;      ///< [m]
  bool right = false;         ///< a circle to the right
  double spacing = 0.5;       ///< of the lateral accelerations of the points [m/s2]
  double acceleration = 0.5;  ///< from point to point [m/s2]
};

struct SteadyCircleResult {
  /// Means over the last second of each speed; to the right all signs are those of the left circle.
  std::vector<CirclePoint> points;
  std::vector<CircleFigures> figures;
  std::string ended;  ///< why the speed was not reached; empty: it was
};

/// The speed of its first point, at which it starts [m/s].
double first_speed(const SteadyCircleOptions& options);
/// Constant radius, one steady state after the other: ISO 4138.
SteadyCircleResult steady_circle(VehicleRun& run, const SteadyCircleOptions& options);

/// From 0 to 1, with two derivatives that are zero at both ends: 10 s^3 - 15 s^4 + 6 s^5, s = t/T.
double smooth_step(double t, double duration) noexcept;

}  // namespace floatframe
