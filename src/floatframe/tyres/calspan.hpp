#pragma once
// The Calspan tyre: side force and aligning moment of slip angle and camber, without a longitudinal
// force.
//   W  = min(Fz, load_limit A2)
//   Ca = A0 + A1 W - (A1/A2) W^2      cornering stiffness [N/rad]
//   Cg = A3 W - (A3/A4) W^2           camber stiffness [N/rad]
//   mu = (B1 Fz + B3 + B4 Fz^2) SN    friction, times that of the road
//   x  = (Ca alpha + Cg gamma) / (mu Fz)
//   f  = x - x |x| / 3 + x^3 / 27 for |x| < 3, else the sign of x
//   Fy = -mu Fz f,  Mz = Fy (AF1 Fz + AF2 |Fy|)
// ISO-W: alpha > 0 towards the left gives Fy < 0, gamma > 0 leans the top to the right. alpha =
// atan(vy / vx) is that of the wheel centre. Above about 26 kN the polynomial mu of the Iltis is
// negative: Fy is odd in it, so that its size is used. The published terms B2 and AF3 are zero in
// all data known and are left out.
// Source: the Iltis benchmark of W. Kortuem, R. S. Sharp (eds.): Multibody Computer Codes in
// Vehicle System Dynamics, 1993.
#include <cmath>

#include "floatframe/math/dual.hpp"

namespace floatframe {

struct Calspan {
  double A0 = 0.0;          ///< [N/rad]
  double A1 = 0.0;          ///< [1/rad]
  double A2 = 1.0;          ///< [N]
  double A3 = 0.0;          ///< [1/rad]
  double A4 = 1.0;          ///< [N]
  double load_limit = 1.0;  ///< Omega_T [-]
  double B1 = 0.0;          ///< [1/N]
  double B3 = 0.0;          ///< [-]
  double B4 = 0.0;          ///< [1/N^2]
  double SN = 1.0;          ///< skid number of the road over that of the test [-]
  double AF1 = 0.0;         ///< [m/N]
  double AF2 = 0.0;         ///< [m/N]
};

template <class S>
struct CalspanForces {
  S Fy, Mz;        ///< [N, N m], ISO-W
  S friction_use;  ///< |Fy| over the largest, 0 to 1
};

template <class S>
S calspan_held_load(const Calspan& c, const S& load) noexcept {
  return load < c.load_limit * c.A2 ? load : S(c.load_limit * c.A2);
}
/// Ca [N/rad] at a load [N].
template <class S>
S calspan_cornering_stiffness(const Calspan& c, const S& load) noexcept {
  const S w = calspan_held_load(c, load);
  return c.A0 + c.A1 * w - c.A1 / c.A2 * w * w;
}
/// Cg [N/rad] at a load [N].
template <class S>
S calspan_camber_stiffness(const Calspan& c, const S& load) noexcept {
  const S w = calspan_held_load(c, load);
  return c.A3 * w - c.A3 / c.A4 * w * w;
}

/// |mu| on a road of the friction factor 1, at a load [N].
template <class S>
S calspan_friction(const Calspan& c, const S& load) noexcept {
  using std::abs;
  return c.SN * abs(S(c.B3 + load * (c.B1 + c.B4 * load)));
}

/// Side force and aligning moment at a load [N], friction factor of the road, slip angle and camber
/// [rad]. B: a scalar of what the slip does not change, as in magic_formula.hpp.
template <class S, class B>
CalspanForces<S> calspan_forces(const Calspan& c, const B& load, double friction, const S& alpha,
                                const B& gamma) noexcept {
  using std::abs;
  CalspanForces<S> out{0.0, 0.0, 0.0};
  if (!(load > 0.0) || !(friction > 0.0)) return out;
  const B limit = friction * load * calspan_friction(c, load);
  const S linear =
      calspan_cornering_stiffness(c, load) * alpha + calspan_camber_stiffness(c, load) * gamma;
  S use = 1.0;
  if (abs(linear) < 3.0 * limit) {
    const S x = abs(linear) / limit;
    use = x * (1.0 - x / 3.0 + x * x / 27.0);
  }
  out.friction_use = use;
  out.Fy = (linear < 0.0 ? limit : B(-limit)) * use;
  out.Mz = out.Fy * (c.AF1 * load + c.AF2 * abs(out.Fy));
  return out;
}

}  // namespace floatframe
