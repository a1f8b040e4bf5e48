#pragma once
// Friction by the deflection z of bristles (Dupont et al. 2002; LuGre: Canudas de Wit et al. 1995),
// per unit of the normal force:
//   zdot = v - a(z, v) |v| z / z_s(v),   z_s = g(v) / sigma_0                                  (1)
//   g    = kinetic + (breakaway - kinetic) exp(-(v / stribeck)^2)                              (2)
//   f    = sigma_0 z + sigma_1 zdot                                                            (3)
// a = 0 up to the deflection z_e = elastic z_s, where the bristles only bend, so nothing creeps
// below breakaway; 1 from z_s on, where all of them slide; between them half a wave of the sine;
// and 0 where v brings z back. elastic = 0: a = 1, the LuGre model, which creeps under loads that
// vary.
#include <cmath>
#include <numbers>

#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

struct Bristles {
  double breakaway = 0.0, kinetic = 0.0;
  double stribeck = 0.0;   ///< 0: kinetic at any speed
  double stiffness = 0.0;  ///< sigma_0
  double damping = 0.0;    ///< sigma_1
  double elastic = 0.95;
};

/// a of (1), z_s = `largest`
template <class S>
S sliding_part(const S& z, const S& v, const S& largest, double elastic) noexcept {
  using std::abs;
  using std::sin;
  if (elastic == 0.0) return 1.0;
  if ((value_of(z) > 0.0) != (value_of(v) > 0.0)) return 0.0;
  const S part = abs(z) / largest;
  if (part <= elastic) return 0.0;
  if (part >= 1.0) return 1.0;
  const double middle = 0.5 * (1.0 + elastic);
  return 0.5 + 0.5 * sin(S((std::numbers::pi / (1.0 - elastic)) * (part - middle)));
}

/// z_s of (1), (2)
template <class S>
S largest_deflection(const Bristles& b, const S& v) noexcept {
  using std::exp;
  S level = b.kinetic;
  if (b.stribeck > 0.0)
    level += (b.breakaway - b.kinetic) * exp(S(-(v * v) / (b.stribeck * b.stribeck)));
  return level / b.stiffness;
}

/// zdot of (1)
template <class S>
S bristle_rate(const Bristles& b, const S& z, const S& v) noexcept {
  using std::abs;
  const S largest = largest_deflection(b, v);
  return v - sliding_part(z, v, largest, b.elastic) * v * abs(z) / largest *
                 ((value_of(z) > 0.0) == (value_of(v) > 0.0) ? 1.0 : -1.0);
}

/// zdot; at rest, where z follows the coordinate, what it follows of v.
template <class S>
S bristle_flow(const Bristles& b, const PortsOf<S>& in, const S& z, const S& v) noexcept {
  return in.rest_slopes ? S(in.rest_slopes[0] * v) : bristle_rate(b, z, v);
}

/// df/ds at rest, df/dv with z following in the step of these ports, and d(zdot)/dz.
struct BristleSlopes {
  double of_place = 0.0, of_speed = 0.0, of_state = 0.0;
};
inline BristleSlopes bristle_slopes(const Bristles& b, const Ports& in, double z,
                                    double v) noexcept {
  if (in.rest_slopes) return {.of_place = b.stiffness * in.rest_slopes[0]};
  const Dual d = bristle_rate(b, Dual::variable(z, 0), Dual::variable(v, 1));
  const double f_z = d.d[0], f_v = d.d[1], z_v = f_v * in.followed(f_z);
  return {.of_speed = b.stiffness * z_v + b.damping * (f_v + f_z * z_v), .of_state = f_z};
}

/// A contact that moves at a start slides: faster than this [m/s or rad/s].
inline constexpr double least_sliding = 1e-3;
/// z at such a start.
inline double bristle_start(const Bristles& b, double v) noexcept {
  return std::abs(v) < least_sliding ? 0.0 : std::copysign(largest_deflection(b, v), v);
}

}  // namespace floatframe
