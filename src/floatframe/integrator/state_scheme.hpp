#pragma once
// The generalised-alpha method of first order (Jansen, Whiting and Hulbert 2000) for the states z
// of elements, zdot = f(ports, z), with the spectral radius rho of the step, in the form of the
// second-order family (augmented_lagrangian.hpp): the equation holds at the end of a step, and the
// algorithm has rates g of its own,
//   z_n+1 = z_n + h (1 - gamma) g_n + h gamma g_n+1                                             (1)
//   (1 - delta_m) g_n+1 + delta_m g_n = (1 - delta_f) zdot_n+1 + delta_f zdot_n                 (2)
//   delta_m = (3 rho - 1) / (2 rho + 2),  delta_f = rho / (rho + 1),
//   gamma = 1/2 + delta_f - delta_m
// and for rho = 1 the trapezoidal rule, g = zdot. From both, zdot_n+1 is linear in z_n+1:
//   zdot_n+1 = w z_n+1 + z_hat,  w = (1 - delta_m) / ((1 - delta_f) gamma h)                    (3)
// so that z_n+1 solves w z + z_hat = f at the ports of each iterate (element_states.hpp). These are
// positions and velocities of the iterate: the velocities are those before the projection at the
// end of the step, which changes them by O(h^2) in directions that the constraints do not allow.
#include "floatframe/integrator/step.hpp"

namespace floatframe {

struct StateScheme {
  StateScheme(double rho, double step) noexcept : h(step), trapezoidal(rho >= 1.0) {
    if (!trapezoidal) {
      delta_m = (3.0 * rho - 1.0) / (2.0 * rho + 2.0);
      delta_f = rho / (rho + 1.0);
      gamma = 0.5 + delta_f - delta_m;
    }
    weight = (1.0 - delta_m) / ((1.0 - delta_f) * gamma * h);
  }
  /// z_hat of (3).
  void history(const State& s, VecX& z_hat) const noexcept {
    const double held = weight * h * (1.0 - gamma) - delta_m / (1.0 - delta_f);
    z_hat = -weight * s.z - held * s.zd_alg - (delta_f / (1.0 - delta_f)) * s.zd;
  }
  /// The states at the end of the step: z, with the history of the state.
  void accept(State& s, const VecX& z, const VecX& z_hat) const noexcept {
    s.zd_alg = (1.0 / (gamma * h)) * (z - s.z - (h * (1.0 - gamma)) * s.zd_alg);
    s.zd = weight * z + z_hat;
    s.z = z;
    if (trapezoidal) s.zd_alg = s.zd;
  }
  double h, delta_m = 0.0, delta_f = 0.0, gamma = 0.5, weight;
  bool trapezoidal;
};

}  // namespace floatframe
