#pragma once
// The driver of a manoeuvre: a path follower and a speed controller by the laws of
// model/path_law.hpp, each evaluated once a step. With the default gains the single-track models of
// docs/vehicle.md are stable from 5 to 40 m/s: all modes decay at 0.5 1/s or faster, with damping
// ratios above 0.39. A mass without resistance follows its speed with the double eigenvalue -1 1/s.
#include "floatframe/model/path_law.hpp"

namespace floatframe {

/// What the driver perceives.
struct DriverView {
  double x = 0.0, y = 0.0;  ///< of the driver's point [m]
  double yaw = 0.0;         ///< heading [rad]
  double speed = 0.0;       ///< along the heading [m/s]
  double yaw_rate = 0.0;    ///< [rad/s]
  double lateral = 0.0;     ///< speed across the heading, to the left [m/s]
};

class PathFollower {
 public:
  PathFollower(DrivenPath path, double wheelbase, const PathGains& gains = {});

  /// The road-wheel angle for the next step of `dt` [rad], positive to the left.
  double steer(const DriverView& view, double dt) noexcept;
  /// Another path from here on, beginning at its first point; the integral goes on.
  void follow(DrivenPath path);
  /// Offset of a point from the path [m], positive: the path is to its left. Looks for the foot
  /// point near that of the last call.
  double offset(double x, double y) noexcept;

 private:
  DrivenPath path_;
  double wheelbase_, at_ = 0.0, integral_ = 0.0;
  PathGains gains_;
};

class SpeedController {
 public:
  /// Mass [kg] and the limits of the force [N].
  SpeedController(double mass, double low, double high, const SpeedGains& gains = {});
  /// The force for the next step of `dt` [N].
  double force(double target, double speed, double dt) noexcept;

 private:
  double mass_, low_, high_, integral_ = 0.0;
  SpeedGains gains_;
};

}  // namespace floatframe
