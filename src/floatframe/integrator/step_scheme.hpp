#pragma once
// The constants of one step size in the generalised-alpha family (augmented_lagrangian.hpp, (a) to
// (h)).
#include <cassert>

#include "floatframe/integrator/step.hpp"

namespace floatframe {

struct StepScheme {
  StepScheme(const StepOptions& o, double step) noexcept : h(step) {
    rho = o.spectral_radius;
    assert(step > 0.0 && std::isfinite(step) && rho >= 0.0 && o.penalty_mass > 0.0);
    trapezoidal = rho >= 1.0;
    am = trapezoidal ? 0.0 : (2.0 * rho - 1.0) / (rho + 1.0);
    af = trapezoidal ? 0.0 : rho / (rho + 1.0);
    gamma = trapezoidal ? 0.5 : 0.5 + af - am;
    beta = trapezoidal ? 0.25 : 0.25 * (gamma + 0.5) * (gamma + 0.5);
    base = 1.0 / (beta * h * h);
    c1 = gamma / (beta * h);
    c2 = (1.0 - am) / ((1.0 - af) * beta * h * h);
    s = 1.0 / c2;
    penalty = o.penalty_mass;
    alpha = penalty / s;
  }
  double h, rho, am, af, gamma, beta, base, c1, c2, s, penalty, alpha;
  bool trapezoidal;
};

}  // namespace floatframe
