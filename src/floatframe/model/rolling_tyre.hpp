#pragma once
// The law of a tyre that rolls, over any scalar; what is special of a kind is in its Law
// (rolling_slips.hpp, with the states and the forces along the road).
// Contact, its frame and its motion V_cx, V_cy, Omega: rolling_contact.hpp. On a carrier, which
// does not spin, Omega is that of a wheel that rolls freely: V_cx/r_e, with r_e of this Omega.
// Wrench at the wheel centre, with the arm to the contact point:
//   F = F_x e_x + F_y e_y + F_z n,  T = arm x F + M_x e_x + s M_y e_y + M_z n,
//   F_z = load(d) + c ddot,  s = w/sqrt(w^2 + v_r^2), w = Omega r_e: the sense of rolling.
// On a carrier no torque about the axis a is left, T.a = 0, by the force along the road
//   F_x = (s M_y cos(gamma) + M_z sin(gamma))/r_l
//   rows   F_z: load' / (e_z.n), c / (e_z.n) along n at P; F_x, F_y: their slopes over V_sx, V_sy
//          with u, v following, along e_x, e_y at P, as far as they damp. They leave out what the
//          horizontal forces have of load and position, the turning of the frame, moments.
//   energy that of F_z(d) if the law has it, else d F_z/2, and C_x u^2/2 + C_y v^2/2
// Branches: pieces of a road under the wheel centre, each with and without contact, as of `tyre`.
#include <limits>

#include "floatframe/model/rolling_contact.hpp"
#include "floatframe/model/rolling_slips.hpp"
#include "floatframe/model/rolling_values.hpp"

namespace floatframe {

/// Signals: the plate of the user, and what lifts the road in linear systems.
inline constexpr std::size_t plate_of_tyre = 0, road_under_tyre = 1;
template <class S>
SignalValue<S> rolling_plate(const PortsOf<S>& in) noexcept {
  const SignalValue<S> plate = in.signal(plate_of_tyre), road = in.signal(road_under_tyre);
  return {S(plate.f + road.f), plate.df + road.df, plate.ddf + road.ddf};
}

/// Omega of a wheel that rolls freely with this contact. Load and radius follow from it so little
/// that each round gives more than one digit.
template <class Law, class S>
S free_spin(const typename Law::Keys& keys, const typename Law::Data& data,
            const RollingContact<S>& c) noexcept {
  constexpr int rounds = 12;
  constexpr double least = 0.1;  // r_e over the radius, of a wheel deep in its road
  const double radius = Law::radius(keys, data), side = Law::mirrored(keys, data) ? -1.0 : 1.0;
  const S deflection = radius - c.loaded_radius, camber = side * c.camber;
  S spin = c.v_cx / radius;
  for (int k = 0; k < rounds; ++k) {
    S load = Law::load(keys, data, deflection, camber, spin) + keys.damping * c.sinking;
    if (value_of(load) < 0.0) load = 0.0;
    S r_e = Law::effective_radius(keys, data, load, deflection, spin);
    if (value_of(r_e) < least * radius) r_e = least * radius;
    const S before = spin;
    spin = c.v_cx / r_e;
    if (std::abs(value_of(spin) - value_of(before)) <= 1e-14 * std::abs(value_of(spin))) break;
  }
  return spin;
}

template <class Law, class S>
RollingContact<S> contact_of_tyre(const PortsOf<S>& in) noexcept {
  const auto& keys = in.template keys<typename Law::Keys>();
  const auto& data = in.template data<typename Law::Data>();
  RollingContact<S> c =
      rolling_contact(in, keys, Law::radius(keys, data), rolling_plate(in), Law::slip_of_centre);
  if (c.found && !keys.spinning) c.spin = free_spin<Law>(keys, data, c);
  return c;
}

/// F_z with its damping, and what it follows from.
template <class S>
struct RollingLoad {
  S deflection = 0.0, load = 0.0;
  double spring = 0.0;     ///< the load without damping: positive where the tyre touches
  double stiffness = 0.0;  ///< of doubles
  bool touches = false;
};
template <class Law, class S>
RollingLoad<S> rolling_load(const PortsOf<S>& in, const RollingContact<S>& c) noexcept {
  const auto& keys = in.template keys<typename Law::Keys>();
  const auto& data = in.template data<typename Law::Data>();
  RollingLoad<S> l;
  if (!c.found) return l;
  l.deflection = Law::radius(keys, data) - c.loaded_radius;
  const double side = Law::mirrored(keys, data) ? -1.0 : 1.0;
  const S camber = side * c.camber;
  if constexpr (std::is_same_v<S, double>) {
    using T = DualNumber<1>;
    const T spring = Law::load(keys, data, T::variable(l.deflection, 0), T(camber), T(c.spin));
    l.load = spring.v;
    l.stiffness = spring.d[0];
  } else {
    l.load = Law::load(keys, data, l.deflection, camber, c.spin);
  }
  l.spring = value_of(l.load);
  l.load += keys.damping * c.sinking;
  l.touches = in.branch == free_branch ? l.spring > 0.0 && value_of(l.load) > 0.0
                                       : RollingBranch{in.branch}.touches();
  return l;
}

/// Rows of the normal force and of the two in the road (element_evaluation.hpp). `slopes`: over u,
/// v, V_sx, V_sy.
void add_rolling_rows(const Ports& in, const RollingContact<double>& c, double stiffness,
                      double damping, bool spinning,
                      const RollingForces<DualNumber<4>, double>& slopes, Efforts& out) noexcept;

/// The sense of rolling of a wheel whose tread moves at this speed.
template <class S>
S sense_of_rolling(const S& speed) noexcept {
  using std::sqrt;
  return speed / S(sqrt(S(speed * speed + rolling::sense_speed * rolling::sense_speed)));
}

/// Of a tyre in the air its states decay.
template <class S>
void rolling_in_air(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  for (int i = 0; i < in.element.states; ++i) {
    out.state_rates[i] = -in.state(i) / rolling::air_time;
    if constexpr (std::is_same_v<S, double>)
      out.state_slopes[i * in.element.states + i] = -1.0 / rolling::air_time;
  }
}

/// Beyond its road: the step fails.
template <class S>
void rolling_off_road(const PortsOf<S>& in, const RollingContact<S>& c,
                      EffortsOf<S>& out) noexcept {
  out.force = std::numeric_limits<double>::quiet_NaN();
  out.wrench[0].F = out.force * c.axis;
  rolling_in_air(in, out);
}

/// Rates of the states and their slopes.
inline void put_rolling_rates(const RollingForces<DualNumber<4>, double>& f,
                              Efforts& out) noexcept {
  out.state_rates[0] = f.u_rate.v;
  out.state_rates[1] = f.v_rate.v;
  for (int i = 0; i < 2; ++i) {
    out.state_slopes[i] = f.u_rate.d[i];
    out.state_slopes[2 + i] = f.v_rate.d[i];
  }
}

/// Wrench and values.
template <class S>
void put_rolling_forces(const RollingContact<S>& c, const RollingMotion<S>& m, const S& r_e,
                        bool spinning, const RollingForces<S>& f, EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  using std::atan2;
  S F_x = f.of.F_x;
  const S M_y = f.of.M_y * sense_of_rolling(spinning ? S(m.spin * r_e) : m.v_cx);
  if (!spinning) F_x = S(M_y * c.e_y.dot(c.axis) + f.of.M_z * c.n.dot(c.axis)) / c.loaded_radius;
  const V F = F_x * c.e_x + f.of.F_y * c.e_y + out.force * c.n;
  const V T = c.arm.cross(F) + f.of.M_x * c.e_x + M_y * c.e_y + f.of.M_z * c.n;
  out.wrench[0] = {F, T};
  out.further[rolling::longitudinal_force] = F_x;
  out.further[rolling::lateral_force] = f.of.F_y;
  out.further[rolling::overturning_moment] = f.of.M_x;
  out.further[rolling::rolling_moment] = M_y;
  out.further[rolling::aligning_moment] = f.of.M_z;
  out.further[rolling::longitudinal_slip] = f.kappa;
  out.further[rolling::slip_angle] = atan2(f.tan_alpha, S(1.0));
  out.further[rolling::friction_use] = f.of.friction_use;
}

/// In the search for an equilibrium a wheel that rolls at the start, or that nothing holds at rest,
/// has its normal force alone: what it gives along the road follows from the motion of the start.
template <class S>
bool rolls_at_rest(const PortsOf<S>& in) noexcept {
  if (in.rest_slopes == nullptr) return false;
  return in.element.states == 0 || value_of(in.states[rolling::states + rolling::rolled]) != 0.0;
}

template <class Law, class S>
void rolling_tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<typename Law::Keys>();
  const auto& data = in.template data<typename Law::Data>();
  const RollingContact<S> c = contact_of_tyre<Law>(in);
  out.length = c.height;
  out.rate = c.height_rate;
  if (std::isnan(value_of(c.height))) return rolling_off_road(in, c, out);
  const RollingLoad<S> l = rolling_load<Law>(in, c);
  if (c.found) {
    out.further[rolling::camber] = c.camber;
    out.further[rolling::deflection] = l.deflection;
    out.further[rolling::loaded_radius] = c.loaded_radius;
    for (int i = 0; i < 3; ++i) out.further[rolling::contact_x + i] = c.point[i];
  }
  if (!l.touches) return rolling_in_air(in, out);
  out.force = l.load;
  if (value_of(l.load) <= 0.0) {  // on a branch that a step leaves
    out.wrench[0].F = l.load * c.n;
    out.wrench[0].T = c.arm.cross(out.wrench[0].F);
    return rolling_in_air(in, out);
  }
  const S r_e = Law::effective_radius(keys, data, l.load, l.deflection, c.spin);
  out.further[rolling::effective_radius] = r_e;
  RollingMotion<S> m{l.load, l.deflection, c.camber,  c.v_cx, S(c.v_cx - c.spin * r_e),
                     c.v_cy, c.spin,       c.friction};
  if (!keys.spinning) m.v_sx = 0.0;
  const bool states = in.element.states > 0;
  if (rolls_at_rest(in)) {
    out.wrench[0].F = l.load * c.n;
    out.wrench[0].T = c.arm.cross(out.wrench[0].F);
    if constexpr (std::is_same_v<S, double>)
      add_rolling_rows(in, c, l.stiffness, keys.damping, keys.spinning, {}, out);
  } else if constexpr (std::is_same_v<S, double>) {
    using T = DualNumber<4>;
    RollingMotion<T, double> at{m.load, m.deflection, m.camber, m.v_cx,
                                m.v_sx, m.v_sy,       m.spin,   m.friction};
    if (keys.spinning) at.v_sx = T::variable(m.v_sx, 2);
    at.v_sy = T::variable(m.v_sy, 3);
    const T z[] = {T::variable(states ? in.state(0) : 0.0, 0),
                   T::variable(states ? in.state(1) : 0.0, 1)};
    RollingForces<T, double> f =
        rolling_slips<Law>(keys, data, at, states ? z : nullptr, in.rest_slopes);
    if (states) put_rolling_rates(f, out);
    if (in.rates_alone) return;
    add_tyre_forces<Law>(keys, data, at, f);
    const TyreForces<T, double>& of = f.of;
    put_rolling_forces(
        c, m, r_e, keys.spinning,
        RollingForces<double>{{of.F_x.v, of.F_y.v, of.M_x, of.M_y, of.M_z, of.friction_use},
                              f.kappa.v,
                              f.tan_alpha.v},
        out);
    out.energy = f.energy.v;
    add_rolling_rows(in, c, l.stiffness, keys.damping, keys.spinning, f, out);
  } else {
    RollingForces<S> f =
        rolling_slips<Law>(keys, data, m, states ? in.states : nullptr, in.rest_slopes);
    add_tyre_forces<Law>(keys, data, m, f);
    put_rolling_forces(c, m, r_e, keys.spinning, f, out);
    out.energy = f.energy;
    if (states) {
      out.state_rates[0] = f.u_rate;
      out.state_rates[1] = f.v_rate;
    }
  }
  if constexpr (requires { Law::energy(keys, data, l.deflection); })
    out.energy += Law::energy(keys, data, l.deflection);
  else
    out.energy += 0.5 * l.load * l.deflection;
}

}  // namespace floatframe
