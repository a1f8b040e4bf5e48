#pragma once
// The beginning of a step of AugmentedLagrangian: its first guess, and the second attempt.
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// The histories v_hat and a_hat, and the first guess of x.
template <EquationsOfMotion F>
inline void AugmentedLagrangian<F>::predict(const State& state, const Scheme& k,
                                            bool careful) noexcept {
  // (a) in (b) and (c), with x = 0 in (a): `known` is -a_alg_n+1 without x.
  const double h = k.h, from_v = h, from_a = h * h * (0.5 - k.beta);
  const VecX& omega2 = f_.own_frequencies_squared();
  assert(omega2.size() == x_.size());
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    const double known = k.base * (from_v * state.v[i] + from_a * state.a_alg[i]);
    v_hat_[i] = state.v[i] + h * (1.0 - k.gamma) * state.a_alg[i] - h * k.gamma * known;
    a_hat_[i] = (k.am * state.a_alg[i] - k.af * state.a[i] - (1.0 - k.am) * known) / (1.0 - k.af);
    // Each coordinate as an uncoupled oscillator (frequency 0 for rigid coordinates), a = f -
    // omega^2 x under a constant load f. A Taylor step would overshoot for modes with omega h >>
    // 1.
    x_[i] = (state.a[i] - a_hat_[i]) / (k.c2 + omega2[i]);
    // Accelerations of massless coordinates are undefined: they follow from positions, and the
    // trapezoidal rule makes them oscillate with alternating sign.
    const double steady = h * state.v[i];
    if (omega2[i] == no_inertia ||
        (careful && omega2[i] == 0.0 && std::abs(x_[i] - steady) > max_predictor_step))
      x_[i] = steady;
  }
  f_.settle(state.q, x_);
  lambda_ = state.lambda;
  if (has_states()) begin_states(state, StateScheme(k.rho, h));
  if (loads_.needed()) loads_.begin();
}

/// Near a singular configuration the penalty may be too small, and a shorter step does not help;
/// or the predictor has moved a body of very small mass too far. Repeats the step with a larger
/// penalty and a predictor that ignores such accelerations.
template <EquationsOfMotion F>
inline void AugmentedLagrangian<F>::retry_step(const State& state, Scheme& k,
                                               StepAttempt& report) noexcept {
  assert(!report.accepted());
  k.penalty *= retry_penalty_factor;
  k.alpha *= retry_penalty_factor;
  StepAttempt again;
  predict(state, k, true);
  newton(state, k, again);
  again.iterations += report.iterations;
  again.factorizations += report.factorizations;
  again.size = report.size;
  report = again;
}

}  // namespace floatframe
