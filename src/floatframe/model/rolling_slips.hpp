#pragma once
// The law of a tyre that rolls without its contact: slips and rates of its states, (1) to (4) of
// rolling_tyre.hpp, and what a Law is. Over two scalars: S of the slips, and B of what they do not
// change. Steps take dual numbers for S and doubles for B: rows need no other derivatives.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/description/tyre_elements.hpp"
#include "floatframe/math/dual.hpp"

namespace floatframe {

/// What the forces of a tyre are made of; angles in rad. `load` is positive. B: the scalar of what
/// the slips do not change, double in steps.
template <class S, class B = S>
struct TyreInput {
  B load;               ///< F_z [N]
  S kappa, tan_alpha;   ///< (2), with their sign at forward and backward rolling: -V_sx/|V_cx|, ...
  B camber;             ///< gamma > 0: the top leans to the right
  B v_cx;               ///< the motion itself [m/s]
  B deflection;         ///< d [m]
  double friction = 1;  ///< factor of the road
};

/// In ISO-W. M_y is that of a wheel that rolls forwards. B: the scalar of what no row needs slopes
/// of, double in steps.
template <class S, class B = S>
struct TyreForces {
  S F_x = 0.0, F_y = 0.0;             ///< [N]
  B M_x = 0.0, M_y = 0.0, M_z = 0.0;  ///< [N m]
  B friction_use = 0.0;               ///< horizontal force over the largest possible one
};

/// Of the carcass and the contact, at a load and camber.
template <class S>
struct TyreLengths {
  S sigma_x, sigma_y;          ///< relaxation lengths, positive [m]
  S stiffness_x, stiffness_y;  ///< C of u and v at rest [N/m]
  S limit_x, limit_y;          ///< L of (4) [m], times the friction of the road
};

/// A Law is a struct of static members:
///   using Keys = ...: the description, a RollingTyre; using Data = ...: what `build` computes
///   static constexpr bool falls;   the force falls beyond its limit: L grows (rolling_tyre.hpp)
///   static constexpr bool slip_of_centre;  slips are those of the wheel centre
///   double radius(const Keys&, const Data&)        unloaded [m]
///   bool mirrored(const Keys&, const Data&)        its data are of the other side
/// and, templates over S:
///   S load(keys, data, S deflection, S camber, S spin)   without damping; below 0 in the air, and
///                                                        smooth there as well
///   S effective_radius(keys, data, S load, S deflection, S spin)
///   TyreLengths<S> lengths(keys, data, S load, S camber, double friction)
///   void limits(keys, data, S load, S camber, double friction, TyreLengths<S>&)
///     may be absent: `lengths` gives lower bounds of the limits, this gives them
///   TyreForces<S, B> forces(keys, data, const TyreInput<S, B>&)   over B as well: S or double
///   S energy(keys, data, S deflection)                     may be absent
/// S: double, Dual, DualNumber<1> and DualNumber<4>.

namespace rolling {
/// Its states, and the kept numbers behind them: rolling_tyre_kind.hpp.
inline constexpr int states = 2, kept = 5;
inline constexpr int place = 0, angle = 3, rolled = 4;  ///< in the kept numbers
inline constexpr double blend = 0.01;                   ///< b of (4)
inline constexpr double steepest = 100.0;               ///< a of (4) does not exceed it
inline constexpr double reach = 10.0;        ///< slip up to which a deflection follows in a slide
inline constexpr double air_time = 0.01;     ///< [s]
inline constexpr double rest_time = 3e-3;    ///< k_v/C without `rest_damping` [s]
inline constexpr double sense_speed = 0.1;   ///< v_r [m/s]
inline constexpr double least_limit = 1e-9;  ///< of a tyre that hardly touches [m]
}  // namespace rolling

/// |x|, with the derivative 0 at 0.
inline double magnitude(double x) noexcept { return std::abs(x); }
template <int n>
DualNumber<n> magnitude(const DualNumber<n>& x) noexcept {
  return chained(std::abs(x.v), x.v > 0.0 ? 1.0 : x.v < 0.0 ? -1.0 : 0.0, x);
}

/// 1/2 (1 + cos(pi speed/full)), 0 above `full`
template <class S>
S fading(const S& speed, double full) noexcept {
  using std::cos;
  if (value_of(speed) >= full) return 0.0;
  return 0.5 + 0.5 * cos(S((std::numbers::pi / full) * speed));
}

/// What the horizontal forces depend on beside the states: S is the scalar of the slips.
template <class S, class B = S>
struct RollingMotion {
  B load, deflection, camber, v_cx;
  S v_sx, v_sy;
  B spin;
  double friction = 1.0;
};

/// Forces, and the rates of the states.
template <class S, class B = S>
struct RollingForces {
  TyreForces<S, B> of;
  S kappa = 0.0, tan_alpha = 0.0;
  S u_rate = 0.0, v_rate = 0.0;
  S energy = 0.0;
};

/// L of (4)
template <class S, class B>
S rolling_limit(bool falls, const B& limit, const B& sigma, const S& still) noexcept {
  const B least = value_of(limit) > rolling::least_limit ? limit : B(rolling::least_limit);
  if (!falls) return least;
  return least + (S(1.0) - still) * (rolling::reach * sigma);
}

/// (4)
template <class S, class B>
void hold_deflections(const S& L_x, const S& L_y, const S& u, const S& v,
                      RollingForces<S, B>& out) noexcept {
  using std::sqrt;
  const S a = u / L_x, b = v / L_y, s = sqrt(S(a * a + b * b));
  if (value_of(s) <= 1.0) return;
  const S growth = (a * out.u_rate / L_x + b * out.v_rate / L_y) / s;
  if (value_of(growth) <= 0.0) return;
  S part = (s - 1.0) / rolling::blend;
  if (value_of(part) > rolling::steepest) part = rolling::steepest;
  const S pull = part * growth / s;
  out.u_rate -= pull * u;
  out.v_rate -= pull * v;
}

/// Lengths of a law with the limits themselves.
template <class Law, class B>
TyreLengths<B> limited_lengths(const typename Law::Keys& keys, const typename Law::Data& data,
                               const B& load, const B& camber, double friction) noexcept {
  TyreLengths<B> l = Law::lengths(keys, data, load, camber, friction);
  if constexpr (requires { Law::limits(keys, data, load, camber, friction, l); })
    Law::limits(keys, data, load, camber, friction, l);
  return l;
}

/// (4). `l`: with lower bounds of the limits, which is enough for a tyre that does not slide.
template <class Law, class S, class B>
void hold_slides(const typename Law::Keys& keys, const typename Law::Data& data,
                 const RollingMotion<S, B>& m, const S* states, TyreLengths<B> l,
                 RollingForces<S, B>& out) noexcept {
  using std::sqrt;
  const double a = value_of(states[0]), b = value_of(states[1]), L_x = value_of(l.limit_x),
               L_y = value_of(l.limit_y);
  if (a * a * L_y * L_y + b * b * L_x * L_x < L_x * L_x * L_y * L_y) return;
  if constexpr (requires { Law::limits(keys, data, m.load, m.camber, m.friction, l); })
    Law::limits(keys, data, m.load, m.camber, m.friction, l);
  S still = 1.0;
  if constexpr (Law::falls)
    still = fading(S(sqrt(S(m.v_sx * m.v_sx + m.v_sy * m.v_sy))), keys.damping_speed);
  hold_deflections(rolling_limit(Law::falls, l.limit_x, l.sigma_x, still),
                   rolling_limit(Law::falls, l.limit_y, l.sigma_y, still), states[0], states[1],
                   out);
}

/// (1) to (4) alone. Without states: the steady slips.
template <class Law, class S, class B>
RollingForces<S, B> rolling_slips(const typename Law::Keys& keys, const typename Law::Data& data,
                                  const RollingMotion<S, B>& m, const S* states,
                                  const double* rest_slopes) noexcept {
  using std::sqrt;
  RollingForces<S, B> out;
  const B speed = magnitude(m.v_cx);
  if (!states) {
    const double least = keys.damping_speed;
    const B along =
        value_of(speed) < least ? B((speed * speed + least * least) / (2.0 * least)) : speed;
    out.kappa = -m.v_sx / along;
    out.tan_alpha = m.v_sy / along;
    return out;
  }
  const S& u = states[0];
  const S& v = states[1];
  const TyreLengths<B> l = Law::lengths(keys, data, m.load, m.camber, m.friction);
  const S slow = fading(S(sqrt(S(m.v_cx * m.v_cx + m.v_sy * m.v_sy))), keys.damping_speed);
  const S t_x = slow *
                (keys.rest_damping ? B(*keys.rest_damping / l.stiffness_x) : B(rolling::rest_time)),
          t_y = slow *
                (keys.rest_damping ? B(*keys.rest_damping / l.stiffness_y) : B(rolling::rest_time));
  out.kappa = (u - t_x * m.v_sx) / l.sigma_x;       // (2)
  out.tan_alpha = -(v - t_y * m.v_sy) / l.sigma_y;  // (2)
  if (rest_slopes) {
    out.u_rate = -rest_slopes[0] * m.v_sx;
    out.v_rate = -rest_slopes[1] * m.v_sy;
  } else {
    out.u_rate = -m.v_sx - speed * u / l.sigma_x;  // (1)
    out.v_rate = -m.v_sy - speed * v / l.sigma_y;  // (1)
    hold_slides<Law>(keys, data, m, states, l, out);
  }
  out.energy = 0.5 * (l.stiffness_x * u * u + l.stiffness_y * v * v);
  return out;
}

/// The law at these slips. `mirrored`: the data are of the other side.
template <class Law, class S, class B>
void add_tyre_forces(const typename Law::Keys& keys, const typename Law::Data& data,
                     const RollingMotion<S, B>& m, RollingForces<S, B>& out) noexcept {
  const double side = Law::mirrored(keys, data) ? -1.0 : 1.0;
  out.of = Law::forces(keys, data,
                       TyreInput<S, B>{m.load, out.kappa, S(side * out.tan_alpha),
                                       B(side * m.camber), m.v_cx, m.deflection, m.friction});
  out.of.F_y *= side;
  out.of.M_x *= side;
  out.of.M_z *= side;
}

}  // namespace floatframe
