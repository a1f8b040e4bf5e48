#pragma once
// The driver of a manoeuvre: a path follower and a speed controller, each evaluated once a step.
//
// Path follower, with one preview point at the distance d = max(v T, d_min) straight ahead and its
// offset e from the path, positive: the path is to the left. The arc that is tangent to the heading
// and passes through the path there has the curvature
//   kappa_d = 2 e/d^2
// and the road-wheel angle is that of a slowly driven arc, corrected by the yaw rate r:
//   delta = L kappa_d + k_r (v kappa_d - r) + k_i integral (v kappa_d - r) dt
// The integral makes the vehicle drive the curvature it is asked for, whatever its understeer. With
// the default gains the single-track models of docs/vehicle.md are stable from 5 to 40 m/s: all
// modes decay at 0.5 1/s or faster, with damping ratios above 0.37.
//
// Speed controller, with the force F on the mass m of the vehicle:
//   F = m (k_p (v_d - v) + k_i integral (v_d - v) dt),  low <= F <= high
// While F is at a limit the integral only changes towards the range (no wind-up). With the default
// gains a mass without resistance follows with the double eigenvalue -1 1/s.
#include <cstddef>
#include <vector>

namespace floatframe {

struct PathPoint {
  double x = 0.0, y = 0.0;  ///< [m]
};

/// A polygon that is driven from its first point to its last; `closed`: and on to the first. Its
/// last side continues straight if it is open. Neighbours differ.
struct DrivenPath {
  std::vector<PathPoint> points;  ///< at least two
  bool closed = false;
};

/// A circle that begins at a point with a heading [rad], driven again and again. Radius [m],
/// positive to the left; `spacing` of its points [m].
DrivenPath circle_path(const PathPoint& begin, double heading, double radius,
                       double spacing = 0.05);
/// From a point along a heading [rad].
DrivenPath straight_path(const PathPoint& from, double heading);

/// What the driver perceives.
struct DriverView {
  double x = 0.0, y = 0.0;  ///< of the driver's point [m]
  double yaw = 0.0;         ///< heading [rad]
  double speed = 0.0;       ///< forward [m/s]
  double yaw_rate = 0.0;    ///< [rad/s]
};

struct PreviewGains {
  double preview_time = 1.0;       ///< T [s]
  double least_distance = 5.0;     ///< d_min [m]
  double yaw_rate = 0.1;           ///< k_r [s]
  double yaw_rate_integral = 0.5;  ///< k_i [1]
  double largest_angle = 0.7;      ///< limit of delta [rad]; the integral stops there
};

class PathFollower {
 public:
  PathFollower(DrivenPath path, double wheelbase, const PreviewGains& gains = {});

  /// The road-wheel angle for the next step of `dt` [rad], positive to the left.
  double steer(const DriverView& view, double dt) noexcept;
  /// Another path from here on; the integral goes on.
  void follow(DrivenPath path);
  /// Offset of a point from the path [m], positive: the path is to its left. Looks for the nearest
  /// side from that of the last call forwards.
  double offset(double x, double y) noexcept;

 private:
  struct Side {
    double x, y, cx, cy, length;  ///< begin, unit direction
  };
  double distance2(std::size_t side, double x, double y) const noexcept;

  std::vector<Side> sides_;
  bool closed_ = false;
  std::size_t at_ = 0;
  double wheelbase_, integral_ = 0.0;
  PreviewGains gains_;
};

struct SpeedGains {
  double proportional = 2.0;  ///< k_p [1/s]
  double integral = 1.0;      ///< k_i [1/s2]
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
