#pragma once
// The laws of a driver, written once for manoeuvres (vehicle/driver.hpp) and for the elements
// path_follower and speed_controller; over any scalar.
//
// Path follower. At the foot point of the vehicle's point on the path: the offset e, positive where
// the path is to the left, and the angle theta from the course (the direction of the velocity,
// speed v) to the path. kappa is the curvature of the path at the distance v T - L/2 ahead, with
// the wheelbase L: T covers the delay of steering and tyres, and a point L/2 ahead of the rear axle
// drives a curve that distance before the vehicle turns. r is the yaw rate.
//   aim       the course that leads to the path: tan(phi) = omega_e e / v
//   demand    r_d = v kappa + omega(v) sin(theta + phi)                                         (1)
//   angle     delta = L r_d / v + k_r (r_d - r) + z                                             (2)
//   integral  zdot = L / (v T_i(v)) (r_d - r)                                                   (3)
//   omega(v) = omega_0 / (1 + (v_1/v)^2 + (v/v_2)^4),  T_i(v) = T_0 (1 + (v_3/v)^3)
// L r_d / v turns a slow vehicle; (3) makes any vehicle turn as demanded, whatever its understeer.
// Both corrections act more slowly where tyres do: at low speeds, whose relaxation takes a length,
// and at high ones. At |delta| = largest_angle z only changes towards the range.
//
// Speed controller with the mass m: F = m (k_p (v_d - v) + z), zdot = k_i (v_d - v)             (4)
#include <cmath>

#include "floatframe/math/dual.hpp"
#include "floatframe/model/driven_path.hpp"

namespace floatframe {

struct PathGains {
  double course = 10.0;                                   ///< omega_0 [1/s]
  double offset = 0.5;                                    ///< omega_e [1/s]
  double preview = 0.2;                                   ///< T [s]
  double yaw_rate = 0.08;                                 ///< k_r [s]
  double integral = 0.05;                                 ///< T_0 [s]
  double largest_angle = 0.7;                             ///< of delta [rad]
  double slow = 12.0, fast = 35.0, integral_slow = 14.0;  ///< v_1, v_2, v_3 [m/s]

  /// omega(v) [1/s]
  template <class S>
  S course_rate(const S& v) const noexcept {
    const S square = v * v, fourth = square * square / (fast * fast * fast * fast);
    return course * square / (square * (1.0 + fourth) + slow * slow);
  }
  /// 1 / (v T_i(v)) [1/m]
  template <class S>
  S integral_rate(const S& v) const noexcept {
    const double third = integral_slow * integral_slow * integral_slow;
    return v * v / (integral * (v * v * v + third));
  }
};

/// What a driver perceives, in the axes of the world.
template <class S>
struct PathView {
  S x, y;      ///< [m]
  S vx, vy;    ///< [m/s]
  S yaw_rate;  ///< [rad/s]
};

template <class S>
struct PathAnswer {
  S angle;   ///< (2), not limited [rad]
  S flow;    ///< (3) [rad/s]
  double s;  ///< of the foot point [m]
  S offset;  ///< e [m]
};

/// `s`: of a point of the path near the foot point. Below 0.1 m/s the course fades away.
template <class S>
PathAnswer<S> path_answer(const DrivenPath& path, const PathGains& gains, double wheelbase,
                          double s, const PathView<S>& view, const S& integral) noexcept {
  using std::sqrt;
  constexpr double crawl = 0.1;  // [m/s]
  PathAnswer<S> out;
  const double x = value_of(view.x), y = value_of(view.y);
  out.s = path.foot(s, x, y);
  const DrivenPath::Value at = path.at(out.s);
  // The foot point follows: ds = c'.dp / (c'.c' - e.c''); its value is zero.
  const double slope = at.dx * at.dx + at.dy * at.dy - (x - at.x) * at.ddx - (y - at.y) * at.ddy;
  const S ds = (at.dx * (view.x - x) + at.dy * (view.y - y)) / slope;
  const S tx = at.dx + at.ddx * ds, ty = at.dy + at.ddy * ds, size = sqrt(tx * tx + ty * ty);
  out.offset = (tx * (at.y + at.dy * ds - view.y) - ty * (at.x + at.dx * ds - view.x)) / size;
  const S v = sqrt(view.vx * view.vx + view.vy * view.vy + crawl * crawl);
  const S sine = (view.vx * ty - view.vy * tx) / (size * v);  // of theta
  const S cosine = (view.vx * tx + view.vy * ty) / (size * v);
  const S aim = gains.offset * out.offset / v;  // tan(phi)
  const double ahead = gains.preview * value_of(v);
  const DrivenPath::Value then = path.at(out.s + ahead - 0.5 * wheelbase);
  const S dq = ds + (gains.preview * v - ahead);
  const S dx = then.dx + then.ddx * dq, dy = then.dy + then.ddy * dq;
  const S bend = dx * (then.ddy + then.dddy * dq) - dy * (then.ddx + then.dddx * dq);
  const S square = dx * dx + dy * dy, kappa = bend / (square * sqrt(square));
  const S demand =
      v * kappa + gains.course_rate(v) * (sine + cosine * aim) / sqrt(1.0 + aim * aim);  // (1)
  const S missing = demand - view.yaw_rate;
  out.angle = wheelbase * demand / v + gains.yaw_rate * missing + integral;  // (2)
  out.flow = wheelbase * gains.integral_rate(v) * missing;                   // (3)
  return out;
}

struct SpeedGains {
  double proportional = 2.0;  ///< k_p [1/s]
  double integral = 1.0;      ///< k_i [1/s2]
};

template <class S>
struct SpeedAnswer {
  S force;  ///< (4), not limited [N]
  S flow;   ///< zdot [m/s3]
};
template <class S>
SpeedAnswer<S> speed_answer(const SpeedGains& gains, double mass, const S& error,
                            const S& integral) noexcept {
  return {mass * (gains.proportional * error + integral), gains.integral * error};
}

/// A value beyond its limits whose integral would drive it on: the integral stops.
inline bool winds_up(double value, double limited, double flow) noexcept {
  return value != limited && (value > limited) == (flow > 0.0);
}

}  // namespace floatframe
