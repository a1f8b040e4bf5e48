#pragma once
// Magic Formula 5.2, 6.1 and 6.2: steady forces and moments of a tyre on its contact point.
// Axes ISO-W: x forward in the wheel plane, y left, z along the road normal. kappa = -Vsx/|Vcx|,
// tan(alpha) = Vcy/|Vcx|, so that a positive angle gives a negative Fy; gamma > 0 leans the top of
// the wheel to the right. Forces act on the tyre.
//   Fx = Gxa(alpha, kappa) Fx0(kappa),   Fy = Gyk(alpha, kappa) Fy0(alpha, gamma) + SVyk
//   Mz = -t(alpha_eq) Fy' + Mzr(alpha_eq) + s Fx
// Fy' = Gyk Fy0(gamma = 0) in 6.x, Fy - SVyk in 5.2. Rolling backwards is the mirror image of
// rolling forwards: Fx(kappa) = -Fx'(-kappa), Fy = Fy', Mx = Mx', My = -My', Mz = -Mz', where the
// formulas with a dash roll forwards. Below a small speed the two blend, so that nothing jumps at
// rest, and without a slope there, which would be a damper that may be negative. No turn slip.
// Where the book's print and the manual of MF-Tyre differ the manual holds, which three public
// programs share: My with Fz0, Mx with atan((QSX6 Fz/Fz0)^2), one cosine in the residual torque,
// equivalent slips with atan and tan, Amu = 1. In the book's form the friction of Fx, Bt, Dt, Mx,
// My and the arm of Fx keep gamma itself, and cos(alpha) is that of the angle.
// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, section 4.3.2, (4.E1) - (4.E78);
// for 5.2 the equations of PAC2002.
#include "floatframe/tyres/magic_curve.hpp"
#include "floatframe/tyres/magic_tyre.hpp"

namespace floatframe {

/// S: the scalar of the slips and of Fx, Fy; B: that of all else. With doubles for B derivatives
/// are those of Fx and Fy over the slips alone.
template <class S, class B = S>
struct MagicInput {
  B load = 0.0;       ///< Fz [N]; none of the forces acts at zero and below
  S kappa = 0.0;      ///< -Vsx/|Vcx|, -1: locked
  S tan_alpha = 0.0;  ///< Vcy/|Vcx|
  B camber = 0.0;     ///< gamma [rad]
  B speed = 0.0;      ///< Vcx [m/s]
  B rolling = 0.0;    ///< Vcx - Vsx = Re omega [m/s]
  B friction = 1.0;   ///< of the road, a factor of both friction coefficients
};

template <class S, class B = S>
struct MagicForces {
  S Fx = 0.0, Fy = 0.0;            ///< [N]
  B Mx = 0.0, My = 0.0, Mz = 0.0;  ///< [N m]
  B Kx = 0.0, Ky = 0.0;            ///< slip stiffnesses; Ky < 0 [N], [N/rad]
  B mux = 0.0, muy = 0.0;          ///< friction coefficients of this load and camber
  B trail = 0.0;                   ///< t [m]
  B residual = 0.0;                ///< Mzr [N m]
};

/// Friction coefficients that fall with the load end here.
inline constexpr double least_friction = 1e-3;

/// What all parts of the formula share.
template <class S, class B = S>
struct MagicState {
  B Fz, dfz;
  S kappa;
  S alpha;      ///< as the form takes it: alpha* of the book
  B gamma;      ///< likewise, gamma*
  B lean;       ///< gamma [rad] in either form
  S cos_alpha;  ///< cos(alpha) in either form
  B friction;
};

/// Friction coefficients of a road of friction 1; the second one is that without its sign.
template <class B>
B magic_friction_x(const MagicTyre& t, const B& dfz, const B& gamma) noexcept {
  return at_least(B(line(t.mux, dfz) * (1.0 - t.mux_camber * gamma * gamma)),
                  least_friction);  // (4.E13)
}
template <class B>
B magic_friction_y(const MagicTyre& t, const B& dfz, const B& square) noexcept {
  return at_least(B(line(t.muy, dfz) * (1.0 - t.muy_camber * square)), least_friction);  // (4.E23)
}

/// Kx divided by Fz.
template <class B>
B magic_slip_stiffness(const MagicTyre& t, const B& dfz) noexcept {
  using std::exp;
  return line(t.Kx, dfz) * exp(B(t.Kx_exponent * dfz));  // (4.E15)
}

/// Kya divided by Fz; negative, and never zero.
template <class B>
B magic_side_stiffness(const MagicTyre& t, const B& Fz, const B& gamma) noexcept {
  using std::abs;
  const B at = at_least(B(t.Ky_load + t.Ky_load_camber * gamma * gamma), 1e-3);
  const B softer = (1.0 - t.Ky_camber * abs(gamma)) / at;
  const B K = softer * sine_over(t.Ky_sine, B(Fz / (t.nominal_load * at)));  // (4.E25)
  return t.Ky * at_least(K, 1e-6);
}

/// Fx0 divided by Fz, its slip stiffness and friction.
template <class S, class B = S>
struct MagicLongitudinal {
  S force;
  B K, mu;
};
template <class S, class B>
MagicLongitudinal<S, B> magic_longitudinal(const MagicTyre& t, const MagicState<S, B>& s) noexcept {
  MagicLongitudinal<S, B> x;
  x.mu = magic_friction_x(t, s.dfz, B(t.gamma_x * s.lean)) * s.friction;
  x.K = magic_slip_stiffness(t, s.dfz);
  const S slip = s.kappa + line(t.SHx, s.dfz);                            // (4.E10)
  const B E = parabola(t.Ex, s.dfz) * (1.0 - t.Ex_side * side_of(slip));  // (4.E14)
  const B steep = x.K / (t.Cx * x.mu);                                    // (4.E16), B
  x.force = x.mu * magic_sine(t.Cx, S(steep * slip), E) +                 // (4.E9)
            line(t.SVx, s.dfz) * s.friction;
  return x;
}

/// Gxa, the weight of Fx0 with a slip angle.
template <class S, class B>
S magic_longitudinal_weight(const MagicTyre& t, const MagicState<S, B>& s) noexcept {
  const S steep = (t.Bxa + t.Bxa_camber * s.gamma * s.gamma) *
                  cos_of_arctan(S(t.Bxa_slip * s.kappa));                              // (4.E54)
  const B E = line(t.Exa, s.dfz);                                                      // (4.E56)
  const S weight = magic_cosine(t.Cxa, S(steep * (s.alpha + t.SHxa)), E);              // (4.E51)
  return t.SHxa == 0.0 ? weight : weight / magic_cosine(t.Cxa, S(steep * t.SHxa), E);  // (4.E52)
}

/// Fy0 divided by Fz and what the moments need of it.
template <class S, class B = S>
struct MagicLateral {
  S force;
  B K, mu;
  B shift;     ///< SHy
  B vertical;  ///< SVy/Fz
  B BC;        ///< By Cy
};
template <class S, class B>
MagicLateral<S, B> magic_lateral(const MagicTyre& t, const MagicState<S, B>& s,
                                 const B& camber) noexcept {
  MagicLateral<S, B> y;
  const B gamma = t.gamma_y * camber;
  const B square = gamma * gamma;
  y.mu = t.muy_side * magic_friction_y(t, s.dfz, square) * s.friction;
  y.K = magic_side_stiffness(t, s.Fz, gamma);
  const B tilted = line(t.SVygamma, s.dfz) * gamma * s.friction;  // (4.E28)
  y.vertical = line(t.SVy, s.dfz) * s.friction + tilted;          // (4.E29)
  y.shift = line(t.SHy, s.dfz) + t.SHy_camber * gamma;            // (4.E27)
  if (t.version != MagicVersion::mf52) y.shift += (line(t.Kygamma, s.dfz) * gamma - tilted) / y.K;
  const S slip = s.alpha + y.shift;  // (4.E20)
  const B E = line(t.Ey, s.dfz) *
              (1.0 + t.Ey_camber * square - (t.Ey_side + t.Ey_side_camber * gamma) * side_of(slip));
  y.BC = y.K / y.mu;                                                         // (4.E26)
  y.force = y.mu * magic_sine(t.Cy, S(y.BC / t.Cy * slip), E) + y.vertical;  // (4.E19)
  return y;
}

/// Gyk, the weight of Fy0 with longitudinal slip.
template <class S, class B>
S magic_lateral_weight(const MagicTyre& t, const MagicState<S, B>& s) noexcept {
  const S steep = (t.Byk + t.Byk_camber * s.gamma * s.gamma) *
                  cos_of_arctan(S(t.Byk_slip * (s.alpha - t.Byk_shift)));  // (4.E62)
  const B E = line(t.Eyk, s.dfz);                                          // (4.E64)
  const B shift = line(t.SHyk, s.dfz);                                     // (4.E65)
  const S weight = magic_cosine(t.Cyk, S(steep * (s.kappa + shift)), E);   // (4.E59)
  const bool shifted = t.SHyk[0] != 0.0 || t.SHyk[1] != 0.0;
  return shifted ? weight / magic_cosine(t.Cyk, S(steep * shift), E) : weight;  // (4.E60)
}

/// SVyk divided by Fz, the lateral force by longitudinal slip.
template <class S, class B>
S magic_slip_force(const MagicTyre& t, const MagicState<S, B>& s, const B& mu) noexcept {
  using std::sin;
  const S most = mu * (line(t.SVyk, s.dfz) + t.SVyk_camber * s.gamma) *
                 cos_of_arctan(S(t.SVyk_angle * s.alpha));               // (4.E67)
  return most * sin(S(t.SVyk_sine * arctan(S(t.SVyk_slip * s.kappa))));  // (4.E66)
}

/// The angle of a slip with the longitudinal one beside it, without its sign: atan(sqrt(tan^2 a +
/// (ratio kappa)^2)), (4.E77) and (4.E78); the functions of it are even.
template <class S>
S magic_equivalent_angle(const S& angle, const S& slip) noexcept {
  using std::atan2, std::cos, std::sin, std::sqrt, std::abs;
  const S c = cos(angle), s = sin(angle);
  return atan2(S(sqrt(S(s * s + slip * slip * c * c))), S(abs(c)));
}

/// Trail, residual torque and the aligning moment of them. `Kx` is divided by Fz.
template <class S, class B>
void magic_aligning(const MagicTyre& t, const MagicState<B>& s, const B& Kx,
                    const MagicLateral<S, B>& y, const B& trailing, MagicForces<S, B>& f) noexcept {
  using std::abs;
  const B gamma = t.gamma_z * s.gamma, lean = t.gamma_z * s.lean;
  const B ratio_slip = Kx / y.K * s.kappa;
  // Trail.
  const B angle = s.alpha + line(t.SHt, s.dfz) + line(t.SHt_camber, s.dfz) * gamma;  // (4.E34)
  const B steep = parabola(t.Bt, s.dfz) *
                  (1.0 + t.Bt_camber * lean + t.Bt_camber_size * abs(lean)) /
                  s.friction;  // (4.E40)
  const B D = s.Fz * line(t.Dt, s.dfz) *
              (1.0 + (t.Dt_camber + t.Dt_camber_square * lean) * lean);  // (4.E42)
  const B E = parabola(t.Et, s.dfz) *
              (1.0 + (t.Et_side + t.Et_side_camber * gamma) * (2.0 / std::numbers::pi) *
                         arctan(B(steep * t.Ct * angle)));  // (4.E44)
  f.trail = D * magic_cosine(t.Ct, B(steep * magic_equivalent_angle(angle, ratio_slip)), E) *
            s.cos_alpha;  // (4.E73)
  // Residual torque, (4.E45) - (4.E47), (4.E75).
  const B other = s.alpha + y.shift + y.vertical / y.K;  // (4.E37)
  const B Br = t.Br / s.friction + t.Br_lateral * y.BC;
  const B Dr = s.Fz *
               (line(t.Dr, s.dfz) +
                (line(t.Dr_camber, s.dfz) + line(t.Dr_camber_size, s.dfz) * abs(gamma)) * gamma) *
               s.friction * s.cos_alpha;
  f.residual = Dr * cos_of_arctan(B(Br * magic_equivalent_angle(other, ratio_slip)));
  const B arm =
      t.arm + t.arm_force * in_scalar<B>(f.Fy) + line(t.arm_camber, s.dfz) * s.lean;  // (4.E76)
  f.Mz = -f.trail * trailing + f.residual + arm * in_scalar<B>(f.Fx);                 // (4.E71)
}

/// Overturning moment, (4.E69).
template <class B>
B magic_overturning(const MagicTyre& t, const MagicState<B>& s, const B& Fy) noexcept {
  using std::cos, std::sin, std::abs;
  const auto& q = t.qsx;
  const B load = s.Fz / t.Fz0;
  const B side = Fy / t.Fz0;
  B sum = q[0] + (-q[1] - q[11] * abs(s.lean)) * s.lean + q[2] * side;
  if (q[3] != 0.0) {
    const B reach = q[5] * load;
    sum += q[3] * cos(B(q[4] * arctan(B(reach * reach)))) *
           sin(B(q[6] * s.lean + q[7] * arctan(B(q[8] * side))));
  }
  if (q[9] != 0.0) sum += q[9] * arctan(B(q[10] * load)) * s.lean;
  return t.R0 * (s.Fz * sum + Fy * (q[12] + q[13] * abs(s.lean)));
}

/// Rolling resistance of a wheel that rolls forwards, (4.E70) in the form of the manual.
template <class B>
B magic_rolling(const MagicTyre& t, const MagicState<B>& s, const B& Fx, const B& speed) noexcept {
  using std::abs, std::pow;
  const auto& q = t.qsy;
  const B load = s.Fz / t.Fz0, square = s.lean * s.lean;
  const B fast = abs(speed) / t.V0, faster = fast * fast;
  const B sum = q[0] + q[1] * Fx / t.Fz0 + q[2] * fast + q[3] * faster * faster +
                (q[4] + q[5] * load) * square;
  return -t.My_scale * sum * (q[6] == 1.0 ? load : B(pow(load, q[6])));
}

/// The forces of a tyre that is not mirrored and rolls forwards; kappa is -Vsx/Vcx.
template <class S, class B>
MagicForces<S, B> magic_forward(const MagicTyre& t, const MagicState<S, B>& s, const B& speed,
                                const B& rolling) noexcept {
  MagicForces<S, B> f;
  const MagicLongitudinal<S, B> x = magic_longitudinal(t, s);
  const MagicLateral<S, B> y = magic_lateral(t, s, s.gamma);
  const S weight = magic_lateral_weight(t, s);
  f.mux = x.mu;
  f.muy = y.mu;
  f.Kx = s.Fz * x.K;
  f.Ky = s.Fz * y.K;
  f.Fx = s.Fz * x.force * magic_longitudinal_weight(t, s);  // (4.E50)
  const S lateral = s.Fz * weight * y.force;
  f.Fy = lateral + s.Fz * magic_slip_force(t, s, y.mu);  // (4.E58)
  const MagicState<B> at{s.Fz,    s.dfz,  in_scalar<B>(s.kappa),     in_scalar<B>(s.alpha),
                         s.gamma, s.lean, in_scalar<B>(s.cos_alpha), s.friction};
  B trailing = in_scalar<B>(lateral);
  if (t.version != MagicVersion::mf52)
    trailing = s.Fz * in_scalar<B>(weight) * magic_lateral(t, at, B(0.0)).force;  // (4.E74)
  magic_aligning(t, at, x.K, y, trailing, f);
  f.Mx = magic_overturning(t, at, in_scalar<B>(f.Fy));
  f.My = magic_rolling(t, at, in_scalar<B>(f.Fx), speed) * smooth_sign(rolling, t.turning_speed);
  return f;
}

/// The forces of a tyre that rolls in one direction, 1 or -1.
template <class S, class B>
MagicForces<S, B> magic_directed(const MagicTyre& t, MagicState<S, B> s, const B& speed,
                                 const B& rolling, double direction) noexcept {
  s.kappa = direction * s.kappa;
  MagicForces<S, B> f = magic_forward(t, s, speed, B(direction * rolling));
  f.Fx = direction * f.Fx;
  f.My = direction * f.My;
  f.Mz = direction * f.Mz;
  return f;
}

/// a f + (1 - a) g.
template <class S, class B>
MagicForces<S, B> magic_blend(const B& a, const MagicForces<S, B>& f,
                              const MagicForces<S, B>& g) noexcept {
  MagicForces<S, B> h = f;
  h.Fx = a * (f.Fx - g.Fx) + g.Fx;
  h.Fy = a * (f.Fy - g.Fy) + g.Fy;
  h.Mx = a * (f.Mx - g.Mx) + g.Mx;
  h.My = a * (f.My - g.My) + g.My;
  h.Mz = a * (f.Mz - g.Mz) + g.Mz;
  h.trail = a * (f.trail - g.trail) + g.trail;
  h.residual = a * (f.residual - g.residual) + g.residual;
  return h;
}

/// Forces and moments of a tyre on its contact point, steady or, with slips that lag behind, of
/// first order. Smooth at rest and without load. Step time: no allocation.
template <class S, class B>
MagicForces<S, B> magic_forces(const MagicTyre& t, const MagicInput<S, B>& in) noexcept {
  using std::cos, std::sin;
  if (!(value_of(in.load) > 0.0)) return {};
  const double m = t.mirror;
  MagicState<S, B> s;
  s.Fz = t.limited ? within(in.load, t.load.least, t.load.most) : in.load;
  s.dfz = (s.Fz - t.nominal_load) / t.nominal_load;  // (4.E2)
  s.friction = value_of(in.friction) < 1e-6 ? B(1e-6) : in.friction;
  s.kappa = t.limited ? within(in.kappa, t.slip.least, t.slip.most) : in.kappa;
  S angle = m * arctan(in.tan_alpha);
  B gamma = m * in.camber;
  if (t.limited) {
    angle = within(angle, t.angle.least, t.angle.most);
    gamma = within(gamma, t.inclination.least, t.inclination.most);
  }
  const bool book = t.form == MagicForm::book;
  s.cos_alpha = cos(angle);
  s.alpha = book ? S(sin(angle) / s.cos_alpha) : angle;  // (4.E3)
  s.gamma = book ? B(sin(gamma)) : gamma;                // (4.E4)
  s.lean = gamma;
  const double V = value_of(in.speed);
  MagicForces<S, B> f = magic_directed(t, s, in.speed, in.rolling, V < 0.0 ? -1.0 : 1.0);
  if (std::abs(V) < t.turning_speed) {
    const B forward = 0.5 * (1.0 + smooth_sign(in.speed, t.turning_speed));
    const MagicForces<S, B> back = magic_directed(t, s, in.speed, in.rolling, V < 0.0 ? 1.0 : -1.0);
    f = V < 0.0 ? magic_blend(forward, back, f) : magic_blend(forward, f, back);
  }
  f.Fy = m * f.Fy;
  f.Mx = m * f.Mx;
  f.Mz = m * f.Mz;
  if (t.limited && value_of(in.load) != value_of(s.Fz)) {
    const B more = in.load / s.Fz;
    for (S* x : {&f.Fx, &f.Fy}) *x = more * *x;
    for (B* x : {&f.Mx, &f.My, &f.Mz, &f.Kx, &f.Ky, &f.residual}) *x = more * *x;
  }
  return f;
}

/// |x| that stays at floor/2 or above, with a continuous slope.
template <class S>
S bounded_speed(const S& x, double floor) noexcept {
  using std::abs;
  if (!(std::abs(value_of(x)) < floor)) return abs(x);
  return 0.5 * (floor + x * x / floor);
}

/// The steady input of velocities of the contact point [m/s]: Vcx, Vcy of the wheel, Vsx = Vcx -
/// Re omega; Vsy = Vcy. Slips are divided by at least half the floor.
template <class S>
MagicInput<S> steady_input(const S& load, const S& Vcx, const S& Vsx, const S& Vcy, const S& camber,
                           double floor = 0.1) noexcept {
  const S speed = bounded_speed(Vcx, floor);
  return {load, -Vsx / speed, Vcy / speed, camber, Vcx, Vcx - Vsx, 1.0};
}

}  // namespace floatframe
