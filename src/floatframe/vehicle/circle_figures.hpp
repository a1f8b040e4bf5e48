#pragma once
// Figures of a steady circle, ISO 4138 at constant radius: how steering, sideslip and roll grow
// with the lateral acceleration. Axes of ISO 8855: x forward, y left; a left circle has positive
// yaw rate, lateral acceleration and steering.
//
//   delta   road-wheel angle, that of the steering input divided by its ratio [rad]
//   delta_A = L r/v   Ackermann angle, of the radius that is driven [rad]
//   K       = d(delta - delta_A)/d a_y   understeer gradient [rad s2/m]
//   alpha_f = delta - beta - l_f r/v,  alpha_r = l_r r/v - beta   slip angles of the axles [rad],
//   positive where they give a force to the left
//
// with the wheelbase L = l_f + l_r, the distances l_f, l_r of the axles from the reference point,
// speed v, yaw rate r and sideslip beta = atan(v_y/v_x) there. Angles are small, as in the
// standard.
#include <optional>
#include <vector>

namespace floatframe {

/// One steady state: means over a time in which nothing changes.
struct CirclePoint {
  double speed = 0.0;                 ///< along the path [m/s]
  double yaw_rate = 0.0;              ///< [rad/s]
  double lateral_acceleration = 0.0;  ///< horizontal, across the heading [m/s2]
  double steering = 0.0;              ///< road-wheel angle [rad]
  double sideslip = 0.0;              ///< [rad]
  double roll = 0.0;                  ///< positive: leans to the right [rad]
  double radius() const noexcept { return speed / yaw_rate; }  ///< positive: to the left [m]
};

/// Distances of the axles from the reference point [m].
struct AxleDistances {
  double front = 0.0, rear = 0.0;
  double wheelbase() const noexcept { return front + rear; }
};

struct CircleFigures {
  double ackermann = 0.0;                ///< delta_A [rad]
  double front_slip = 0.0;               ///< alpha_f [rad]
  double rear_slip = 0.0;                ///< alpha_r [rad]
  double steering_gradient = 0.0;        ///< d delta / d a_y [rad s2/m]
  double understeer_gradient = 0.0;      ///< K [rad s2/m]
  double sideslip_gradient = 0.0;        ///< d beta / d a_y [rad s2/m]
  double roll_gradient = 0.0;            ///< d roll / d a_y [rad s2/m]
  std::optional<double> characteristic;  ///< speed sqrt(L/K) [m/s], if K > 0
  std::optional<double> critical;        ///< speed sqrt(-L/K) [m/s], if K < 0
};

/// The figures of each point. Gradients are the slope, there, of the parabola through it and its
/// neighbours, at the ends through the last three: exact if a quantity is quadratic in a_y. The
/// points are sorted by a_y, all different, at least two (with two: the straight line).
std::vector<CircleFigures> circle_figures(const std::vector<CirclePoint>& points,
                                          const AxleDistances& axles);

/// The slope of y over x at each point, as above.
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace floatframe
