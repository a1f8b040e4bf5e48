#pragma once
// The end of a step of AugmentedLagrangian: states and values of elements at the last iterate, and
// the projections (i) and (j).
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// Those of the last iterate, which is not evaluated further.
template <EquationsOfMotion F>
inline void AugmentedLagrangian<F>::end_states(StepAttempt& report) noexcept {
  if (report.accepted()) f_.solve_element_states();
  check_states(report);
  if (loads_.needed()) report.load_contraction = loads_.contraction();
  f_.element_states().stop();
}

/// Of elements that no force depends on at present.
template <EquationsOfMotion F>
inline void AugmentedLagrangian<F>::check_values(StepAttempt& report, double end) const noexcept {
  if (!report.accepted()) return;
  report.element = f_.undefined_element(end);
  if (report.element >= 0) report.status = AttemptStatus::not_finite;
}

/// Projects velocities and accelerations onto the constraints, orthogonally in W = M + 0.01 s K
/// (the Newton tangent would feed energy into stiff modes). False if W is singular.
template <EquationsOfMotion F>
inline bool AugmentedLagrangian<F>::project(const Scheme& k, StepAttempt& report) noexcept {
  assert(report.accepted() && f_.constraints() > 0);
  double penalty = metric_penalty * k.penalty;
  int pivot = f_.factorize_metric(0.01 * k.s, penalty, projection_slot);
  ++report.factorizations;
  for (int retry = 0; pivot >= 0 && retry < max_penalty_reductions; ++retry) {
    penalty *= penalty_reduction;
    pivot = f_.factorize_metric(0.01 * k.s, penalty, projection_slot);
    ++report.factorizations;
  }
  if (pivot >= 0) {
    report.status = AttemptStatus::singular_tangent;
    report.coordinate = pivot;
    return false;
  }
  report.log_pivots = f_.log_pivots(projection_slot);
  project_velocities(penalty, report);
  f_.velocities(v_);
  f_.constraint_accelerations(a_, rate_);
  const double first = largest(rate_);
  double violation = first;
  reactions_ = lambda_;
  for (int pass = 0; pass < options_.max_projections; ++pass) {
    // To 1e-6 m/s2 or nine digits. A violation not halved after four passes is round-off or the
    // result of contradicting constraints.
    if (violation < 1e-6 + 1e-9 * first || (pass > 3 && violation > 0.5 * first)) break;
    correct(a_, penalty);
    violation = largest(rate_);
    // W times the change of a is -Phi_q^T penalty mu.
    reactions_ += penalty * work_;
  }
  return true;
}

template <EquationsOfMotion F>
inline void AugmentedLagrangian<F>::project_velocities(double penalty,
                                                       StepAttempt& report) noexcept {
  if (keeps_impulses_) impulses_.setZero();
  f_.constraint_rates(rate_);
  report.velocity_violation = largest(rate_);
  const double enough = 0.1 * options_.velocity_tolerance;
  for (int pass = 0; pass < options_.max_projections && report.velocity_violation >= enough;
       ++pass) {
    const double before = report.velocity_violation;
    correct(v_, penalty);
    if (keeps_impulses_) impulses_ += penalty * work_;
    report.velocity_violation = largest(rate_);
    if (report.velocity_violation > min_projection_rate * before) break;
  }
}

}  // namespace floatframe
