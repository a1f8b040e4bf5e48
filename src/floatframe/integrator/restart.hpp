#pragma once
// A step of AugmentedLagrangian starts from velocities that satisfy the constraints and
// accelerations that satisfy the equations of motion. Both are computed again where steps are
// divided at a discontinuity of forces.
#include <cassert>

#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

/// Projects the velocities of a state that no step of size h has produced onto the constraints.
template <EquationsOfMotion F>
void AugmentedLagrangian<F>::project_velocities(State& state, double h) noexcept {
  assert(fits(state));
  if (f_.constraints() == 0) return;
  const Scheme k(options_, h);
  kinematics_at(f_, state);
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

/// Accelerations and multipliers at the state after a discontinuity of forces; h: step size.
/// Returns false and leaves the state unchanged if the equations do not determine them (a massless
/// coordinate). Evaluates positions, velocities and `dynamics` at the state.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::restart(State& state, double h) noexcept {
  assert(fits(state) && all_finite(state.a));
  const Scheme k(options_, h);
  a_ = state.a;
  lambda_.setZero();
  if (!solve_accelerations(state, k, k.penalty, 1e-9)) return false;
  state.a.swap(a_);
  state.a_alg = state.a;
  if (has_states()) state.zd = state.zd_alg = f_.element_states().rates();
  if (loads_.needed()) state.z = f_.element_states().values();
  reactions_ = state.lambda = lambda_;
  return true;
}

/// The same between steps of equal size, where forces may jump at each step. The iteration starts
/// from the old multipliers. The lead of the algorithm's acceleration, (alpha_m - alpha_f) h times
/// its rate, comes from the smooth part of the forces and is kept: a reset at each step would leave
/// a first-order scheme. An error e of the acceleration gives h e/2 in velocity: seven digits
/// suffice.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::restart_in_course(State& state, double h) noexcept {
  assert(fits(state) && all_finite(state.a) && all_finite(state.lambda));
  const Scheme k(options_, h);
  a_ = state.a;
  lambda_ = state.lambda;
  if (!solve_accelerations(state, k, metric_penalty * k.penalty, 1e-7)) return false;
  state.a_alg += a_ - state.a;
  state.a.swap(a_);
  if (has_states()) {
    state.zd_alg += f_.element_states().rates() - state.zd;
    state.zd = f_.element_states().rates();
  }
  if (loads_.needed()) state.z = f_.element_states().values();
  reactions_ = state.lambda = lambda_;
  return true;
}

/// Iterates a_ and lambda_ to the solution at the state, with the tolerance `enough`.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::solve_accelerations(const State& state, const Scheme& k,
                                                 double penalty, double enough) noexcept {
  assert(penalty > 0.0 && enough > 0.0);
  kinematics_at(f_, state);
  f_.dynamics();
  // First without stiffness, which would slow down convergence.
  if (iterate_accelerations(0.0, penalty, enough)) return true;
  a_ = state.a;
  lambda_.setZero();
  return iterate_accelerations(0.01 * k.s, k.penalty, enough);
}

/// Solves M a + Phi_q^T lambda = Q, Phi_q a = gamma for a_ and lambda_, by passes with M + s K and
/// a penalty. False if they do not converge.
template <EquationsOfMotion F>
bool AugmentedLagrangian<F>::iterate_accelerations(double s, double penalty,
                                                   double enough) noexcept {
  assert(s >= 0.0 && a_.size() == f_.velocities() && lambda_.size() == f_.constraints());
  constexpr int most_passes = 40;
  constexpr double no_stiffness = 1e-30;
  if (f_.factorize_metric(s > 0.0 ? s : no_stiffness, penalty, projection_slot) >= 0) return false;
  const bool exact = f_.constraints() == 0 && !(s > 0.0) && !loads_.needed();
  double last = std::numeric_limits<double>::infinity();
  if (loads_.needed()) loads_.begin();
  for (int pass = 0; pass < most_passes; ++pass) {
    if (loads_.needed()) loads_.iterate(f_, a_, lambda_);
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
