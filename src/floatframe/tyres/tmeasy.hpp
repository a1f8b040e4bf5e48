#pragma once
// TMeasy: forces of a tyre from slopes, maxima and sliding values that are given at two loads.
//   loads       W = min(Fz, max_load), r = W / pn; values a at pn and b at 2 pn:
//               forces and slopes dF0, FM, FS: W / pn (2 a - b/2 - (a - b/2) r)
//               slips sM, sS, s0, sE and the trail n: a + (b - a)(r - 1)
//   friction    the factor mu of the road scales FM, FS, sM, sS, s0, sE, and not dF0
//   slip        sN = (sx / hx, sy / hy), s = |sN|, (c, d) = sN / s, with the normalising factors
//               hx = sMx / (sMx + sMy) + FMx/dF0x / (FMx/dF0x + FMy/dF0y), hy with x and y swapped;
//               hx = hy = 1 if not `normalised`
//   combined    dF0 = |(dF0x hx c, dF0y hy d)|, sM = |(sMx c / hx, sMy d / hy)|,
//               FM = |(FMx c, FMy d)|, sS and FS likewise; Fx = F(s) c, Fy = F(s) d
//   curve       s < sM:  F = dF0 s / (1 + q (q + p)), q = s / sM, p = dF0 sM / FM - 2
//               s < sS:  two parabolas, FM - a (s - sM)^2 up to s* and FS + b (sS - s)^2 beyond,
//                        a = (FM/sM)^2 / (dF0 sM), s* = sM + (FM - FS) / (a (sS - sM)),
//                        b = a (s* - sM) / (sS - s*); where s* > sS a cubic instead:
//                        FM - (FM - FS) q^2 (3 - 2 q), q = (s - sM) / (sS - sM)
//               beyond:  F = FS
//   trail       n/L = n0 (1 - w/s0) (1 - w/sE)^2 (1 + (1/s0 + 2/sE) w), w = |sy| < sE, else 0;
//               Mz = -(n/L) L Fy, contact length L = 2 sqrt(R0 Fz / cz)
// The slips are TMeasy's own: sx = -(vx - rD Omega) / (rD |Omega|), sy = -vy / (rD |Omega|). Fx has
// the sign of sx, Fy that of sy. Below slips of about 1e-8 the direction (c, d) is faded to the
// mean, but for the slopes of each axis, so that forces and derivatives at zero slip are those of
// dF0x and dF0y.
// Source: G. Rill, A. A. Castro: Road Vehicle Dynamics, 2nd edition, chapter 3.
#include <algorithm>
#include <cmath>

#include "floatframe/math/dual.hpp"

namespace floatframe {

/// A value at the nominal load pn and at 2 pn.
struct TwoLoads {
  double nominal = 0.0, twice = 0.0;
};

/// The characteristic of one direction: initial slope [N], maximum and sliding force [N], and the
/// slips of both [-].
struct TmeasyAxis {
  TwoLoads slope, maximum, sliding;
  TwoLoads maximum_slip, sliding_slip;
};

/// Pneumatic trail over the contact length: that at zero slip, the slips at which its sign changes
/// and at which it ends [-].
struct TmeasyTrail {
  TwoLoads at_zero, zero_slip, end_slip;
};

struct Tmeasy {
  double nominal_load = 0.0;  ///< pn [N]
  double max_load = 0.0;      ///< above which the tables are held [N]
  TmeasyAxis x, y;
  TmeasyTrail trail;
  double radius = 0.0;     ///< unloaded, R0 [m]
  double stiffness = 0.0;  ///< vertical, cz [N/m]: for the contact length alone
  bool normalised = true;  ///< Rill's generalised slip; false: without its normalising factors
};

template <class S>
struct TmeasyForces {
  S Fx, Fy;        ///< [N], ISO-W
  S trail;         ///< over the contact length [-]
  S Mz;            ///< [N m]
  S friction_use;  ///< the resultant over the largest one in this direction, 0 to 1
};

/// A force or slope over its load, of the quadratic function of the load.
template <class S>
S tmeasy_per_load(const TwoLoads& t, double nominal_load, const S& load) noexcept {
  const double half = t.nominal - 0.5 * t.twice;
  return (t.nominal + half - half / nominal_load * load) / nominal_load;
}
/// A slip or trail, linear in the load.
template <class S>
S tmeasy_linear(const TwoLoads& t, double nominal_load, const S& load) noexcept {
  return t.nominal - (t.twice - t.nominal) + (t.twice - t.nominal) / nominal_load * load;
}

template <class S>
S tmeasy_held_load(const Tmeasy& t, const S& load) noexcept {
  return load < t.max_load ? load : S(t.max_load);
}

/// The slopes dF0x, dF0y of both forces at zero slip [N].
template <class S>
S tmeasy_slope(const Tmeasy& t, const TmeasyAxis& axis, const S& load) noexcept {
  const S w = tmeasy_held_load(t, load);
  return w * tmeasy_per_load(axis.slope, t.nominal_load, w);
}

/// F(s) / s of the curve with the initial slope dF0 and its maximum FM at sM, sliding with FS from
/// sS on.
template <class S>
S tmeasy_curve_over_slip(const S& dF0, const S& FM, const S& FS, const S& sM, const S& sS,
                         const S& s) noexcept {
  if (s < sM) {
    const S q = s / sM;
    return dF0 / (1.0 + q * (q + dF0 * sM / FM - 2.0));
  }
  if (!(s < sS)) return FS / s;
  const S steep = FM / sM;
  const S a = steep * steep / (dF0 * sM);
  const S joint = sM + (FM - FS) / (a * (sS - sM));
  if (joint > sS) {
    const S q = (s - sM) / (sS - sM);
    return (FM - (FM - FS) * q * q * (3.0 - 2.0 * q)) / s;
  }
  if (s < joint) return (FM - a * (s - sM) * (s - sM)) / s;
  if (!(joint < sS)) return FS / s;
  return (FS + a * (joint - sM) / (sS - joint) * (sS - s) * (sS - s)) / s;
}

/// One direction at a load and a friction: forces over the load.
template <class S>
struct TmeasyValues {
  S slope, maximum, sliding, maximum_slip, sliding_slip;
  TmeasyValues(const TmeasyAxis& a, double nominal, const S& load, const S& friction) noexcept
      : slope(tmeasy_per_load(a.slope, nominal, load)),
        maximum(friction * tmeasy_per_load(a.maximum, nominal, load)),
        sliding(friction * tmeasy_per_load(a.sliding, nominal, load)),
        maximum_slip(friction * tmeasy_linear(a.maximum_slip, nominal, load)),
        sliding_slip(friction * tmeasy_linear(a.sliding_slip, nominal, load)) {}
};

/// The trail over the contact length at the lateral slip sy.
template <class S, class B>
S tmeasy_trail(const Tmeasy& t, const B& load, const B& friction, const S& sy) noexcept {
  using std::abs;
  const double pn = t.nominal_load;
  const B w = tmeasy_held_load(t, load);
  const B end = friction * tmeasy_linear(t.trail.end_slip, pn, w);
  const S slip = abs(sy);
  if (!(slip < end)) return 0.0;
  const B zero = friction * tmeasy_linear(t.trail.zero_slip, pn, w);
  const S rest = 1.0 - slip / end;
  return tmeasy_linear(t.trail.at_zero, pn, w) * (1.0 - slip / zero) * rest * rest *
         (1.0 + (1.0 / zero + 2.0 / end) * slip);
}

/// Forces and aligning moment at a load [N], a friction factor and the slips sx, sy. B: a scalar of
/// what the slips do not change, as in magic_formula.hpp.
template <class S, class B>
TmeasyForces<S> tmeasy_forces(const Tmeasy& t, const B& load, const B& friction, const S& sx,
                              const S& sy) noexcept {
  using std::sqrt;
  TmeasyForces<S> out{0.0, 0.0, 0.0, 0.0, 0.0};
  if (!(load > 0.0) || !(friction > 0.0)) return out;
  const B w = tmeasy_held_load(t, load);
  const TmeasyValues<B> x(t.x, t.nominal_load, w, friction), y(t.y, t.nominal_load, w, friction);
  B hx = 1.0, hy = 1.0;
  if (t.normalised) {
    const B qx = x.maximum / x.slope, qy = y.maximum / y.slope;
    const B slips = x.maximum_slip + y.maximum_slip;
    hx = x.maximum_slip / slips + qx / (qx + qy);
    hy = y.maximum_slip / slips + qy / (qx + qy);
  }
  constexpr double small = 1e-16;  // the square of a slip without direction
  const S nx = sx / hx, ny = sy / hy;
  const S square = nx * nx + ny * ny + small;
  const S c2 = (nx * nx + 0.5 * small) / square, d2 = (ny * ny + 0.5 * small) / square;
  const auto combined = [&](const B& ax, const B& ay) -> S {
    return sqrt(S(ax * ax * c2 + ay * ay * d2));
  };
  const B slope_x = x.slope * hx, slope_y = y.slope * hy;
  const S slope = combined(slope_x, slope_y), s = sqrt(square);
  const S maximum = combined(x.maximum, y.maximum);
  const S force = tmeasy_curve_over_slip<S>(slope, maximum, combined(x.sliding, y.sliding),
                                            combined(x.maximum_slip / hx, y.maximum_slip / hy),
                                            combined(x.sliding_slip / hx, y.sliding_slip / hy), s);
  // The slopes of each axis where the slip has no direction, the combined one elsewhere.
  const B ax = slope_x * slope_x, ay = slope_y * slope_y;
  const S of_x = sqrt(S((ax * (nx * nx + small) + ay * ny * ny) / square)) / slope;
  const S of_y = sqrt(S((ax * nx * nx + ay * (ny * ny + small)) / square)) / slope;
  out.Fx = w * force * of_x * nx;
  out.Fy = w * force * of_y * ny;
  out.friction_use = force * s / maximum;
  out.trail = tmeasy_trail(t, load, friction, sy);
  const B contact_length = 2.0 * sqrt(B(t.radius / t.stiffness * load));
  out.Mz = -out.trail * contact_length * out.Fy;
  return out;
}

}  // namespace floatframe
