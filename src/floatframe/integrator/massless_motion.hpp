#pragma once
// Motions without mass that stiffness holds: the spin of a bar without inertia about its axis that
// a torsion spring ties to a body with inertia. They follow the others by statics, as in linear
// analyses. The trapezoidal rule knows no static motion: it turns an error of the rate over in each
// step, and what it makes of accelerations grows with each (a double root of -1), until the small
// mass that the bent bar has feeds it into the rest. So after a step velocities and accelerations
// are divided by
//   P z = W^-1 M z,  Phi_q P z = Phi_q z,  W = M + part s K,                                (k)
// which takes out of z what has no mass, and that part is replaced by that of the generalised-alpha
// rule of spectral radius 0, which follows displacements x to second order and forgets:
//   a_0 = (x - h v_n + h^2 a_n / 2) / h^2,  v_0 = v_n - h a_n / 2 + 3 h a_0 / 2               (l)
//   v = v_0 + P (v - v_0),  a = a_0 + P (a - a_0).
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// (k) and (l) for v_ and a_ at the end of a step from `state`; as they are where W is singular.
/// Leaves accelerations of another kind in the formulation. A mode of frequency omega counts as one
/// without mass where part (omega h)^2 / 4 is not small.
template <EquationsOfMotion F>
void AugmentedLagrangian<F>::follow_massless(const State& state, const Scheme& k) noexcept {
  constexpr double part = 1e-5;
  const double h = k.h;
  const bool constrained = f_.constraints() > 0;
  const double penalty = metric_penalty * k.penalty;
  f_.velocities(v_);
  f_.dynamics();
  increments_.setZero();
  v_hat_.setZero();
  f_.residual(v_hat_, increments_, 0.0, a_hat_);  // without accelerations
  if (f_.factorize_metric(part * k.s, penalty, projection_slot) >= 0) return;
  const auto keep_mass = [&](VecX& z, const VecX& smooth) {
    delta_ = z - smooth;
    f_.residual(delta_, increments_, 0.0, rhs_);
    rhs_ -= a_hat_;
    if (constrained) {
      f_.constraint_increments(delta_, rate_);
      rate_ = -rate_;
      f_.solve(rhs_, rate_, penalty, work_, projection_slot);
    } else {
      f_.solve(rhs_, projection_slot);
    }
    z = smooth + rhs_;
  };
  a_alg_ = (x_ - h * state.v + (0.5 * h * h) * state.a_alg) / (h * h);
  v_hat_ = state.v - (0.5 * h) * state.a_alg + (1.5 * h) * a_alg_;
  keep_mass(v_, v_hat_);
  keep_mass(a_, a_alg_);
}

}  // namespace floatframe
