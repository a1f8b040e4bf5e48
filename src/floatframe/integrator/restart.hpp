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
  a_ = state.a;
  lambda_.setZero();
  if (!solve_accelerations(state, k, k.penalty, 1e-9)) return false;
  state.a.swap(a_);
  state.a_alg = state.a;
  reactions_ = state.lambda = lambda_;
  return true;
}

/// The same between steps of one size, where forces may jump at each. What multipliers were is not
/// far away, and what the algorithm's acceleration is ahead of the acceleration by, (alpha_m -
/// alpha_f) h times its rate, is of the smooth part of the forces and stays: started anew at each
/// step it would leave a scheme of first order. An error e of accelerations is one of h e/2 of
/// velocities: seven digits are enough.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::restart_in_course(State& state, double h) noexcept {
  const Scheme k(options_, h);
  a_ = state.a;
  lambda_ = state.lambda;
  if (!solve_accelerations(state, k, metric_penalty * k.penalty, 1e-7)) return false;
  state.a_alg += a_ - state.a;
  state.a.swap(a_);
  reactions_ = state.lambda = lambda_;
  return true;
}

/// Improves a_ and lambda_ to those of the forces at the state, but for the part `enough`.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::solve_accelerations(const State& state, const Scheme& k,
                                                 double penalty, double enough) noexcept {
  f_.positions(state.t, state.q);
  f_.velocities(state.v);
  f_.dynamics();
  // Without stiffness first: it would slow the passes down.
  if (settle_accelerations(0.0, penalty, enough)) return true;
  a_ = state.a;
  lambda_.setZero();
  return settle_accelerations(0.01 * k.s, k.penalty, enough);
}

/// M a + Phi_q^T lambda = Q, Phi_q a = gamma for a_ and lambda_, by passes with M + s K and a
/// penalty. False if they do not settle.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::settle_accelerations(double s, double penalty,
                                                  double enough) noexcept {
  constexpr int most_passes = 40;
  constexpr double no_stiffness = 1e-30;
  if (f_.factorize_metric(s > 0.0 ? s : no_stiffness, penalty, projection_slot) >= 0) return false;
  const bool exact = f_.constraints() == 0 && !(s > 0.0);
  double last = std::numeric_limits<double>::infinity();
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
    const double change = largest(delta_), most = enough * (1.0 + largest(a_));
    if (!(most < enough * options_.largest_acceleration)) return false;
    // The next pass would change it by change^2 / last.
    if (exact ||
        (pass > 0 && (change < most || (change < 0.5 * last && change * change < most * last))))
      return true;
    last = change;
  }
  return false;
}

}  // namespace floatframe
