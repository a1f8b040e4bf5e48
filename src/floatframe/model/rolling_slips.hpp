#pragma once
// Slips, states and horizontal forces of a tyre that rolls, over any scalar. Slip velocities
//   V_sx = V_cx - Omega r_e,  V_sy = V_cy;  V_sx = 0 of a wheel that rolls freely on its carrier
// States: the deflections u, v of the carcass along and across [m],
//   udot = -V_sx - |V_cx| u/sigma_x,  vdot = -V_sy - |V_cx| v/sigma_y                           (1)
// and from them the slips that the law of the forces sees,
//   kappa = (u - t_x V_sx)/sigma_x,  tan(alpha) = -(v - t_y V_sy)/sigma_y                       (2)
//   t = k_v/(2 C) (1 + cos(pi |V_c|/v_d)) below |V_c| = v_d, 0 above                            (3)
// In steady rolling these are kappa = -V_sx/|V_cx|, tan(alpha) = V_cy/|V_cx|. At rest the states
// are springs of the stiffness C = slip stiffness / sigma with the dampers k_v, so that a parked
// vehicle stands and rocks, and |V| has no floor: nothing creeps.
// A deflection is held where the law gives its largest force, L = (L_x, L_y), while it would grow:
// with s = |(u/L_x, v/L_y)| and the growth g = ds/dt of (1), where g > 0,
//   (udot, vdot) -= a g (u, v)/s,  a = (s - 1)/b above s = 1                                    (4)
// so that s settles at 1 + b while it slides; without it a slide would wind the states up to sigma
// and throw the vehicle back when it ends. Of a law whose force falls beyond its limit L grows with
// the speed of sliding up to `reach` sigma, by (1 - p), p = (3) over k_v/C with V_s in the place of
// V_c. As it stops, its deflections come back to where the force is largest, at any g:
//   (udot, vdot) -= p (s - 1)/T (u, v)/s above s = 1                                            (5)
// for beyond it a contact that sticks would be a spring of negative stiffness, and two of them that
// hold against each other would not stand. In the air states decay with the time `air_time`.
// Without `relaxation` there are none, and it creeps:
//   kappa = -V_sx/V*, tan(alpha) = V_sy/V*, V* = |V_cx|, below v_d (V_cx^2 + v_d^2)/(2 v_d)
// A tyre of the other side sees -gamma, -tan(alpha) and gives -F_y, -M_x, -M_z. Without friction of
// the road there are no forces along it and no M_z.
#include <algorithm>
#include <numbers>

#include "floatframe/description/tyre_elements.hpp"
#include "floatframe/model/element_evaluation.hpp"

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
  B friction_use = 0.0;               ///< over the largest horizontal force; 1 if there is none
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
///   static constexpr bool falls;         the force falls beyond the limit: L grows, see above
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
inline constexpr double settle_time = 5e-3;  ///< T of (5) [s]
inline constexpr double least_limit = 1e-3;  ///< L over sigma; less of friction and load
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
  const B shortest = rolling::least_limit * sigma;
  const B least = value_of(limit) > value_of(shortest) ? limit : shortest;
  if (!falls) return least;
  return least + (S(1.0) - still) * (rolling::reach * sigma);
}

/// (4) and, with p > 0, (5)
template <class S, class B>
void hold_deflections(const S& L_x, const S& L_y, const S& u, const S& v, const S& p,
                      RollingForces<S, B>& out) noexcept {
  using std::sqrt;
  const S a = u / L_x, b = v / L_y, s = sqrt(S(a * a + b * b));
  if (value_of(s) <= 1.0) return;
  const S growth = (a * out.u_rate / L_x + b * out.v_rate / L_y) / s;
  S pull = p * (s - 1.0) / rolling::settle_time;
  if (value_of(growth) > 0.0) {
    S part = (s - 1.0) / rolling::blend;
    if (value_of(part) > rolling::steepest) part = rolling::steepest;
    pull += part * growth;
  }
  pull /= s;
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

/// (4) and (5). `l`: with lower bounds of the limits, enough for a tyre that does not slide.
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
  S still = 1.0, back = 0.0;
  if constexpr (Law::falls)
    back = still = fading(S(sqrt(S(m.v_sx * m.v_sx + m.v_sy * m.v_sy))), keys.damping_speed);
  hold_deflections(rolling_limit(Law::falls, l.limit_x, l.sigma_x, still),
                   rolling_limit(Law::falls, l.limit_y, l.sigma_y, still), states[0], states[1],
                   back, out);
}

/// (1) to (5) alone. Without states: the steady slips.
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
  if (m.friction > 0.0) return;
  out.of.F_x = out.of.F_y = 0.0;
  out.of.M_z = 0.0;
  out.of.friction_use = 1.0;
}

}  // namespace floatframe
