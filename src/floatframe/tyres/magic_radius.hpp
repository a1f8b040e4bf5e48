#pragma once
// Radii, load, patch and relaxation lengths of a Magic Formula tyre. R_omega = R0 (q_re0 + q_v1
// (R0 omega/V0)^2) is the free radius of the spinning tyre, rho = R_omega - Rl its deflection:
//   6.1  Fz = (1 + q_v2 R0 |omega|/V0 - (q_fcx Fx/Fz0)^2 - (q_fcy Fy/Fz0)^2) Q(rho) (1 + ppz dpi)
//        Q(rho) = (q_fz1 rho/R0 + q_fz2 (rho/R0)^2) Fz0
//   6.2  as 6.1, with rho changed by the camber and (rho/R0)^q_fcy2 q_fcy (Fy - S gamma)/Fz0
//   5.2  Fz = Cz rho
//   Re = R_omega - Fz0/Cz (dreff atan(breff Fz/Fz0) + freff Fz/Fz0)
//   6.x  sigma_x = Kx/Cx, sigma_y = |Kya|/Cy;   5.2  by PTX and PTY
// Fz depends on Fx and Fy, which depend on Fz: a small fixed point (balanced_load).
// Source: I. J. M. Besselink et al., The Magic Formula/Swift tyre model that can handle inflation
// pressure changes, Vehicle System Dynamics 48 (2010); Pacejka 2012, chapter 9; for the load of
// 6.2 the manual of MF-Tyre 6.2; for 5.2 PAC2002.
#include <algorithm>

#include "floatframe/tyres/magic_formula.hpp"

namespace floatframe {

/// Free radius of the tyre at an angular velocity [m], [rad/s].
template <class S>
S free_radius(const MagicTyre& t, const S& spin) noexcept {
  const S turn = t.R0 / t.V0 * spin;
  return t.R0 * (t.q_re0 + t.q_v1 * turn * turn);
}

/// rho of 6.2: what camber adds to R_omega - Rl. Far in the air it grows no further.
template <class S>
S cambered_deflection(const MagicTyre& t, const S& radius, const S& free, const S& gamma) noexcept {
  using std::abs, std::cos, std::sin;
  constexpr double far = 1.1;
  S rho = free - radius;
  const S tilted = rho;
  if (t.q_cam[0] != 0.0 || t.q_cam[1] != 0.0) {
    const S near = value_of(radius) < far * value_of(free) ? radius : S(far * free);
    const S shape =
        (t.q_cam[0] + t.q_cam[1] * near) * (near / free) / (t.q_cam[0] + t.q_cam[1] * free);
    rho += shape * shape * (t.tread / 8.0) * abs(S(sin(gamma) / cos(gamma)));
  }
  return rho - t.q_cam[2] * tilted * abs(gamma);
}

/// Load [N] of a loaded radius [m] without damping, with the forces Fx and Fy [N]; in the air it
/// continues in a straight line below zero, so that it is zero where the tyre begins to touch.
template <class S>
S magic_load(const MagicTyre& t, const S& radius, const S& camber, const S& spin, const S& Fx,
             const S& Fy) noexcept {
  using std::abs, std::pow;
  const S free = free_radius(t, spin);
  const S faster = 1.0 + t.q_v2 * t.R0 / t.V0 * abs(spin);
  const S gamma = t.mirror * camber;
  const bool mf62 = t.version == MagicVersion::mf62;
  const S rho = mf62 ? cambered_deflection(t, radius, free, gamma) : S(free - radius);
  if (!(value_of(rho) > 0.0)) return faster * (t.qz[0] / t.R0) * rho;
  S side = t.q_fcy * t.mirror * Fy / t.Fz0;
  if (mf62) {
    const S ratio = radius / free;
    const S skew = t.q_fys[0] + (t.q_fys[1] + t.q_fys[2] * ratio) * ratio;
    side = t.q_fcy * (t.mirror * Fy - skew * gamma) / t.Fz0;
    if (t.q_fcy2 != 0.0) side = side * pow(S(rho / t.R0), t.q_fcy2);
  }
  const S along = t.q_fcx * Fx / t.Fz0;
  const S factor = faster - along * along - side * side;
  const S x = rho / t.R0;
  S load = value_of(factor) > 0.0 ? S(factor * (t.qz[0] + t.qz[1] * x) * x) : S(0.0);
  const S bottom = t.bottom_radius - radius;
  if (value_of(bottom) > 0.0) load += t.bottom_stiffness * bottom;
  return load;
}

/// True if the load depends on the forces of the contact point.
inline bool load_depends_on_forces(const MagicTyre& t) noexcept {
  return t.q_fcx != 0.0 || t.q_fcy != 0.0;
}

/// Load [N] of a loaded radius [m] where the forces are those of this load: Fz = G(Fz), G(F) =
/// magic_load with Fx(F) and Fy(F). `forces(F)` gives a MagicForces over the scalar of F, where all
/// but the load are held. At most twelve iterations by Newton's method; G' is about -0.1, so three
/// do. Derivatives are those of the solution: dFz = dG/(1 - G').
template <class S, class Forces>
S balanced_load(const MagicTyre& t, const S& radius, const S& camber, const S& spin,
                const Forces& forces) noexcept {
  const S zero = 0.0;
  if (!load_depends_on_forces(t)) return magic_load(t, radius, camber, spin, zero, zero);
  using D = DualNumber<1>;
  const D r = value_of(radius), gamma = value_of(camber), omega = value_of(spin);
  double F = magic_load(t, r.v, gamma.v, omega.v, 0.0, 0.0);
  if (!(F > 0.0)) return magic_load(t, radius, camber, spin, zero, zero);
  double slope = 0.0;
  for (int k = 0; k < 12; ++k) {
    const MagicForces<D> f = forces(D::variable(F, 0));
    const D G = magic_load(t, r, gamma, omega, f.Fx, f.Fy);
    slope = std::min(G.d[0], 0.9);
    const double change = (G.v - F) / (1.0 - slope);
    F = std::max(F + change, 0.0);
    if (!(F > 0.0) || std::abs(change) <= 1e-14 * F) break;
  }
  if (!(F > 0.0)) return zero;
  const MagicForces<S> f = forces(S(F));
  const S G = magic_load(t, radius, camber, spin, S(f.Fx), S(f.Fy));
  return F + (G - F) / (1.0 - slope);
}

/// Effective rolling radius [m]: Vx = Re omega of a wheel that rolls freely.
template <class S>
S magic_effective_radius(const MagicTyre& t, const S& load, const S& spin) noexcept {
  const S x = load / t.Fz0;
  return free_radius(t, spin) - t.Fz0 / t.Cz * (t.dreff * arctan(S(t.breff * x)) + t.freff * x);
}

/// Half length and half width of the contact patch [m].
struct MagicPatch {
  double length = 0.0, width = 0.0;
};
inline MagicPatch magic_patch(const MagicTyre& t, double load) noexcept {
  if (!(load > 0.0)) return {};
  const double x = load / (t.Cz * t.R0);
  return {t.R0 * (t.q_ra[0] * std::sqrt(x) + t.q_ra[1] * x),
          t.width * (t.q_rb[0] * std::cbrt(x) + t.q_rb[1] * x)};
}

/// A = tan(pi/(2 C)), where sin(C atan(A)) is largest; a curve of C near 1 and below, which has no
/// peak, is taken where it is within 1 % of its limit.
inline double magic_peak_argument(double C) noexcept {
  constexpr double latest = 1.43;
  return std::tan(std::min(0.5 * std::numbers::pi / C, latest));
}
inline constexpr double farthest_peak = 30.0;
/// The slip times B of that: A = y - E (y - atan(y)). Newton's method on the value, which is
/// monotonic here; the derivative is that of the solution.
template <class S>
S magic_peak(double argument, const S& E) noexcept {
  const double e = std::min(value_of(E), 1.0);
  double y = std::min(argument, farthest_peak), slope = 1.0;
  for (int k = 0; k < 20; ++k) {
    slope = 1.0 - e * (1.0 - 1.0 / (1.0 + y * y));
    const double change = (argument - y + e * (y - std::atan(y))) / std::max(slope, 1e-6);
    y = std::clamp(y + change, 0.0, farthest_peak);
    // What is left is the square of it, and the last line takes that as well.
    if (std::abs(change) <= 1e-5 * y || y == farthest_peak) break;
  }
  if (y == farthest_peak || value_of(E) > 1.0) return y;
  return y + (argument - y + E * (y - std::atan(y))) / slope;
}
/// It is not below this: y - atan(y) is between 0 and y.
template <class S>
double least_magic_peak(double argument, const S& E) noexcept {
  return std::min(argument / (1.0 + std::max(0.0, -value_of(E))), farthest_peak);
}

template <class S>
struct MagicLengths {
  S sigma_x = 0.0, sigma_y = 0.0;  ///< relaxation lengths [m]
  S Cx = 0.0, Cy = 0.0;            ///< stiffnesses of the standing tyre [N/m]
};
/// Slips of the largest forces on a road of friction 1, without shifts [-], [rad].
template <class S>
struct MagicPeaks {
  S x = 0.0, y = 0.0;
};
/// What both follow from.
template <class S>
struct MagicStanding {
  S Fz, dfz, gamma;
  S Kx, Ky;  ///< divided by Fz
  MagicStanding(const MagicTyre& t, const S& load, const S& camber) noexcept
      : Fz(t.limited ? within(load, t.load.least, t.load.most) : load),
        dfz((Fz - t.nominal_load) / t.nominal_load),
        gamma(t.mirror * camber) {
    if (t.limited) gamma = within(gamma, t.inclination.least, t.inclination.most);
    Kx = magic_slip_stiffness(t, dfz);
    Ky = magic_side_stiffness(t, Fz, S(t.gamma_y * gamma));
  }
};
/// At a positive load and a camber. `least`: lower bounds of them, which cost little.
template <class S>
MagicPeaks<S> magic_peaks(const MagicTyre& t, const MagicStanding<S>& s, bool least) noexcept {
  using std::abs;
  const S leaning = t.gamma_y * s.gamma, square = leaning * leaning;
  const S Ex = parabola(t.Ex, s.dfz), Ey = line(t.Ey, s.dfz) * (1.0 + t.Ey_camber * square);
  const S x = least ? S(least_magic_peak(t.peak_x, Ex)) : magic_peak(t.peak_x, Ex);
  const S y = least ? S(least_magic_peak(t.peak_y, Ey)) : magic_peak(t.peak_y, Ey);
  return {x * t.Cx * magic_friction_x(t, s.dfz, S(t.gamma_x * s.gamma)) / s.Kx,
          y * t.Cy * abs(S(magic_friction_y(t, s.dfz, square) / s.Ky))};
}
/// Relaxation lengths at a load and a camber.
template <class S>
MagicLengths<S> magic_lengths(const MagicTyre& t, const S& load,
                              const MagicStanding<S>& s) noexcept {
  using std::exp, std::abs;
  MagicLengths<S> l;
  const S Kx = s.Kx * load, Ky = abs(S(s.Ky * load));
  if (t.fixed_sigma > 0.0) {
    l.sigma_x = l.sigma_y = t.fixed_sigma;
  } else if (t.version == MagicVersion::mf52) {
    l.sigma_x = s.Fz * line(t.sigma_x, s.dfz) * exp(S(t.sigma_x_exponent * s.dfz));
    // sin(2 atan(p)) = 2 p/(1 + p^2)
    const S part = s.Fz / t.sigma_y_load;
    l.sigma_y = t.sigma_y * 2.0 * part / (1.0 + part * part) *
                (1.0 - t.sigma_y_camber * abs(S(t.gamma_y * s.gamma)));
  } else {
    l.Cx = parabola(t.stiffness_x, s.dfz);
    l.Cy = parabola(t.stiffness_y, s.dfz);
    l.sigma_x = Kx / l.Cx;
    l.sigma_y = Ky / l.Cy;
    return l;
  }
  l.Cx = Kx / l.sigma_x;
  l.Cy = Ky / l.sigma_y;
  return l;
}
/// At zero load those of 6.x and 5.2 vanish.
template <class S>
MagicLengths<S> magic_lengths(const MagicTyre& t, const S& load, const S& camber) noexcept {
  if (!(value_of(load) > 0.0)) return {};
  return magic_lengths(t, load, MagicStanding<S>(t, load, camber));
}

}  // namespace floatframe
