#pragma once
// A step of AugmentedLagrangian begins with velocities on the constraints and with the
// accelerations of the forces there. Where steps are divided because forces jump, both are made
// anew.
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// Velocities of a state that was moved otherwise than by a step of size h onto the constraints.
template <EquationsOfMotion F>
void AugmentedLagrangian<F>::project_velocities(State& state, double h) noexcept {
  if (f_.constraints() == 0) return;
  const Scheme k(options_, h);
  f_.positions(state.t, state.q);
  f_.velocities(state.v);
  f_.dynamics();
  f_.residual(state.a, state.lambda, 0.0, rhs_);
  const double penalty = metric_penalty * k.penalty;
  if (f_.factorize_metric(0.01 * k.s, penalty, projection_slot) >= 0) return;
  f_.constraint_rates(rate_);
  for (int pass = 0; pass < options_.max_projections; ++pass) {
    if (!(largest(rate_) >= 0.1 * options_.velocity_tolerance)) break;
    correct(state.v, penalty);
  }
}

/// Accelerations and multipliers of the forces at the state, where these have jumped; h: the size
/// of steps. False, and the state is as it was, if the equations do not determine them: a freedom
/// without mass. Leaves positions, velocities and `dynamics` of the state.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::restart(State& state, double h) noexcept {
  const Scheme k(options_, h);
  f_.positions(state.t, state.q);
  f_.velocities(state.v);
  f_.dynamics();
  // Without stiffness first: it would slow the passes down.
  if (!solve_accelerations(state, 1e-30, k.penalty) &&
      !solve_accelerations(state, 0.01 * k.s, k.penalty))
    return false;
  state.a.swap(a_);
  state.a_alg = state.a;
  reactions_ = state.lambda = lambda_;
  return true;
}

/// M a + Phi_q^T lambda = Q, Phi_q a = gamma into a_ and lambda_, by passes with M + s K and a
/// penalty. False if they do not settle.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::solve_accelerations(const State& state, double s,
                                                 double penalty) noexcept {
  constexpr int most_passes = 40;
  constexpr double enough = 1e-9, too_large = 1e7;  // of accelerations
  a_ = state.a;
  lambda_.setZero();
  f_.residual(a_, lambda_, 0.0, rhs_);
  if (f_.factorize_metric(s, penalty, projection_slot) >= 0) return false;
  for (int pass = 0; pass < most_passes; ++pass) {
    f_.residual(a_, lambda_, 0.0, rhs_);
    f_.balance(lambda_, rhs_);
    delta_ = -rhs_;
    if (f_.constraints() > 0) {
      f_.constraint_accelerations(a_, rate_);
      f_.solve(delta_, rate_, penalty, work_, projection_slot);
      lambda_ += penalty * work_;
    } else {
      f_.solve(delta_, projection_slot);
    }
    a_ += delta_;
    const double change = largest(delta_), size = 1.0 + largest(a_);
    if (!(size < too_large)) return false;
    if (pass > 0 && change < enough * size) return true;
  }
  return false;
}

}  // namespace floatframe
