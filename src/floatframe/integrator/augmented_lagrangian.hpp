#pragma once
// Index-3 augmented Lagrangian with mass-orthogonal projections (paper eqs (1), (2); theory section
// 11), for any formulation that satisfies the concept in formulation/equations_of_motion.hpp.
//
// Unknown of a step of size h: the increment x of the configuration, q_n+1 = q_n (+) x (rotation
// vectors for quaternions). With the generalised-alpha family (Chung and Hulbert 1993; Arnold and
// Bruels 2007) of the spectral radius rho (rho = 1 is the trapezoidal rule of the paper:
// gamma = 1/2, beta = 1/4, alpha_m = alpha_f = 0)
//   alpha_m = (2 rho - 1)/(rho + 1),  alpha_f = rho/(rho + 1),
//   gamma = 1/2 + alpha_f - alpha_m,  beta = (gamma + 1/2)^2 / 4
//   a_alg_n+1 = (x - h v_n - h^2 (1/2 - beta) a_alg_n) / (beta h^2)                             (a)
//   v = v_n + h (1 - gamma) a_alg_n + h gamma a_alg_n+1                                         (b)
//   (1 - alpha_f) a + alpha_f a_n = (1 - alpha_m) a_alg_n+1 + alpha_m a_alg_n                   (c)
// velocities and accelerations are linear in x:
//   v = c1 x + v_hat,  c1 = gamma / (beta h)                                                    (d)
//   a = c2 x + a_hat,  c2 = (1 - alpha_m) / ((1 - alpha_f) beta h^2),  s = 1/c2                 (e)
// Newton, with (1) divided by c2:
//   T dx = -s [M a + Phi_q^T (alpha Phi + lambda) - Q]                                          (f)
//   T = M + (c1/c2) C + s (K + Phi_q^T alpha Phi_q)                                             (g)
//   x (+)= dx,  lambda += alpha (Phi + Phi_q dx)                                                (h)
// where (h) is alpha Phi(q) up to the curvature of the constraints. C and K contain modal damping
// and stiffness, the rows of force tangents (element_evaluation.hpp) and geometric stiffness; T
// omits the derivatives of M and Q_v, which costs iterations, not accuracy. Multipliers act with
// -Phi_q^T lambda.
// Projections, (2), with a separate metric, factorised once per step with the Jacobian frozen:
//   W = M + 0.01 s K,  T_p = W + 30 s Phi_q^T alpha Phi_q                                       (i)
//   v -= T_p^-1 30 s Phi_q^T alpha Phi_dot(v),  a -= T_p^-1 30 s Phi_q^T alpha Phi_ddot(a),     (j)
// repeated until the tolerance.
//
// States of elements follow the iterate (state_scheme.hpp); C and K contain what follows from them.
// Signals between elements are a low-rank part of T (signal_update.hpp). Friction from reactions
// follows the iterate (load_iteration.hpp).
// Nothing here allocates after construction, throws or prints. The state changes only when the step
// is accepted.
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/integrator.hpp"
#include "floatframe/integrator/load_iteration.hpp"
#include "floatframe/integrator/signal_update.hpp"
#include "floatframe/integrator/state_scheme.hpp"
#include "floatframe/integrator/step_scheme.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

template <EquationsOfMotion F>
class AugmentedLagrangian final : public Integrator {
 public:
  AugmentedLagrangian(F& formulation, const StepOptions& options)
      : Integrator(options, formulation.constraints()),
        f_(formulation),
        signals_(formulation),
        loads_(formulation) {
    const int nv = f_.velocities(), nc = f_.constraints();
    q_ = VecX::Zero(f_.configurations());
    x_ = v_ = a_ = a_alg_ = rhs_ = delta_ = v_hat_ = a_hat_ = VecX::Zero(nv);
    lambda_ = rate_ = work_ = increments_ = VecX::Zero(nc);
    z_hat_ = VecX::Zero(f_.element_states().count());
  }

  StepAttempt attempt(State& state, double h) noexcept override {
    assert(h > 0.0 && fits(state) && all_finite(state.q));
    f_.stepping(true);
    Scheme k(options_, h);
    StepAttempt report;
    report.size = h;
    // A reuse record of another run must have no effect (the caller may round t).
    if (!(std::abs(state.t - reuse_.valid_at) < 1e-6 * h)) reuse_.contraction = 0.1;
    predict(state, k, false);
    newton(state, k, report);
    if (!report.accepted() && report.iterations > 0 && f_.constraints() > 0 && !has_thrown())
      retry_step(state, k, report);
    if (has_states()) end_states(report);
    check_values(report, state.t + h);
    if (!report.accepted() && has_thrown()) report.status = AttemptStatus::law_failed;
    if (!report.accepted()) {
      reuse_.valid_at = std::numeric_limits<double>::quiet_NaN();
    } else if (f_.constraints() == 0 || project(k, report)) {
      if (has_states()) accept_states(state, StateScheme(k.rho, h));
      accept(state, k);
    }
    f_.stepping(false, report.accepted());
    return report;
  }

  void project_velocities(State& state, double h) noexcept override;
  bool restart(State& state, double h) noexcept override;
  bool restart_in_course(State& state, double h) noexcept override;

 private:
  using Clock = std::chrono::steady_clock;
  using Scheme = StepScheme;
  static constexpr int newton_slot = 0, projection_slot = 1;
  /// The projections are linear: a larger penalty saves passes, but amplifies round-off.
  static constexpr double metric_penalty = 30.0;
  /// The entry of a massless coordinate is its stiffness times s, which may be below the round-off
  /// of the penalty. After a vanishing pivot the penalty is reduced by this factor, up to three
  /// times; the multiplier update removes the remaining error of the finite penalty.
  static constexpr double penalty_reduction = 1e-2;
  static constexpr int max_penalty_reductions = 3;
  static constexpr double retry_penalty_factor = 100.0;
  /// A predictor that moves a rigid coordinate further than this in a step [m, rad] is suspect: the
  /// second attempt drops the acceleration from it.
  static constexpr double max_predictor_step = 0.1;
  /// Passes stop at one that leaves more than this fraction: near singular configurations, more
  /// would turn round-off of nearly dependent constraints into velocities.
  static constexpr double min_projection_rate = 0.5;

  /// The force is then not a number, and the iteration has ended.
  bool has_thrown() const noexcept { return f_.thrown().element >= 0; }

  bool fits(const State& s) const noexcept {
    return has_sizes(s, f_.configurations(), f_.velocities(), f_.constraints());
  }

  bool has_states() const noexcept { return z_hat_.size() > 0; }
  /// From now on the states follow, beginning at a first guess.
  void begin_states(const State& s, const StateScheme& scheme) noexcept {
    assert(s.z.size() == z_hat_.size() && s.zd.size() == s.z.size());
    assert(s.zd_alg.size() == s.z.size());
    scheme.history(s, z_hat_);
    f_.element_states().give(s.z);
    f_.element_states().follow(scheme.weight, z_hat_);
  }
  void end_states(StepAttempt& report) noexcept;
  void check_values(StepAttempt& report, double end) const noexcept;
  bool check_states(StepAttempt& report) const noexcept {
    if (f_.element_states().unsolved() < 0) return true;
    report.status = AttemptStatus::states_not_solved;
    report.element = f_.element_states().unsolved();
    return false;
  }
  /// Kept numbers change at the end of the step, with the projected velocities.
  void accept_states(State& s, const StateScheme& scheme) noexcept {
    scheme.accept(s, f_.element_states().values(), z_hat_);
    f_.change_kept_states();
    s.z = f_.element_states().values();
    if (!loads_.needed()) return;
    f_.element_states().clear_kept_rates(s.zd);
    f_.element_states().clear_kept_rates(s.zd_alg);
  }

  /// The state at the end of the step.
  void accept(State& state, const Scheme& k) noexcept {
    const double h = k.h;
    assert(x_.allFinite() && q_.allFinite());  // or not converged
    a_alg_ = k.base * (x_ - h * state.v - (h * h * (0.5 - k.beta)) * state.a_alg);
    state.t += h;
    reuse_.valid_at = state.t;
    state.q.swap(q_);
    state.v.swap(v_);
    state.a.swap(a_);
    if (k.trapezoidal)
      state.a_alg = state.a;
    else
      state.a_alg.swap(a_alg_);
    state.lambda.swap(lambda_);
    assert(fits(state));
  }

  void predict(const State& state, const Scheme& k, bool careful) noexcept;
  void retry_step(const State& state, Scheme& k, StepAttempt& report) noexcept;

  /// State of the Newton iteration between two passes.
  struct Iterate {
    double increment = 0.0;  ///< largest coordinate of the last dx
    double error = 0.0;      ///< estimate of the remaining error
    double penalty, alpha;   ///< of the scheme, or reduced
    bool renew = true;       ///< the tangent is factorised again
    Clock::time_point begin;
  };

  void newton(const State& state, const Scheme& k, StepAttempt& report) noexcept {
    const bool constrained = f_.constraints() > 0;
    assert(report.iterations == 0 && k.penalty > 0.0 && k.alpha >= 0.0);  // 0: h^2 overflows
    Iterate it;
    it.penalty = k.penalty;
    it.alpha = k.alpha;
    it.begin = options_.time_budget > 0.0 ? Clock::now() : Clock::time_point{};
    while (true) {
      f_.retract(state.q, x_, q_);
      v_ = k.c1 * x_ + v_hat_;  // (d)
      a_ = k.c2 * x_ + a_hat_;  // (e)
      // Without constraints the end state of a converged step need not be evaluated.
      if (report.iterations == 0 || constrained || has_states() ||
          !is_converged(report, it.error)) {
        f_.positions(state.t + k.h, q_);
        f_.velocities(v_);
      }
      if (report.iterations > 0) {
        if (is_finished(it, report)) return;
        choose_tangent(it);
      }
      f_.dynamics();
      if (has_states() && !check_states(report)) return;
      if (loads_.needed())
        loads_.follow(f_, a_, lambda_, it.penalty, report.iterations > 0 ? newton_slot : -1);
      f_.residual(a_, lambda_, 0.0, rhs_);
      f_.balance(lambda_, rhs_);
      if (it.renew && !renew_tangent(k, it, report)) return;
      solve_increment(k, it);
      f_.advance(x_, delta_);
      measure(it, report);
    }
  }

  /// True if the iteration is finished: converged, failed, or out of iterations or time.
  bool is_finished(const Iterate& it, StepAttempt& report) const noexcept {
    if (f_.constraints() > 0) report.position_violation = largest(f_.constraint_values());
    if (!std::isfinite(it.increment) || !std::isfinite(report.position_violation)) {
      report.status = AttemptStatus::not_finite;
      return true;
    }
    const bool converged = is_converged(report, it.error);
    if (options_.fixed_iterations > 0) {
      if (report.iterations >= options_.fixed_iterations) {
        if (!converged) report.status = AttemptStatus::cut_short;
        return true;
      }
    } else if (converged) {
      return true;
    } else if (report.iterations >= options_.max_iterations) {
      report.status = AttemptStatus::not_converged;
      if (it.error >= options_.tolerance)
        report.coordinate = index_of_largest(delta_);
      else
        report.constraint = index_of_largest(f_.constraint_values());
      return true;
    }
    if (options_.time_budget > 0.0 &&
        std::chrono::duration<double>(Clock::now() - it.begin).count() > options_.time_budget) {
      if (!converged) report.status = AttemptStatus::cut_short;
      return true;
    }
    return false;
  }

  /// Decides whether a new tangent pays off: at a rate above 0.9 the old one hardly converges; else
  /// compares the remaining iterations at that rate with one iteration plus its factorisation.
  void choose_tangent(Iterate& it) noexcept {
    assert(reuse_.contraction >= 0.0 && reuse_.contraction <= 1.0 && it.increment >= 0.0);
    it.renew = reuse_.contraction > 0.9 ||
               std::log(options_.tolerance / it.increment) / std::log(reuse_.contraction) >
                   1.0 + F::factorization_cost;
    // The recorded rate decays, so that reuse is tried again after some steps.
    if (it.renew) reuse_.contraction *= 0.8;
  }

  /// (g). False if it is singular, even with a reduced penalty.
  bool renew_tangent(const Scheme& k, Iterate& it, StepAttempt& report) noexcept {
    assert(it.alpha >= 0.0 && it.penalty > 0.0);
    int pivot = f_.factorize(1.0, k.c1 / k.c2, k.s, it.alpha, newton_slot);
    ++report.factorizations;
    for (int retry = 0; f_.constraints() > 0 && pivot >= 0 && retry < max_penalty_reductions;
         ++retry) {
      it.penalty *= penalty_reduction;
      it.alpha *= penalty_reduction;
      pivot = f_.factorize(1.0, k.c1 / k.c2, k.s, it.alpha, newton_slot);
      ++report.factorizations;
    }
    if (pivot < 0 && signals_.renew(f_, k.c1 / k.c2, k.s, it.penalty, newton_slot)) return true;
    assert(pivot < f_.velocities());
    if (!std::isfinite(largest(rhs_))) {  // so is the stiffness of forces
      report.status = AttemptStatus::not_finite;
      return false;
    }
    report.status = AttemptStatus::singular_tangent;
    report.coordinate = pivot < 0 ? index_of_largest(rhs_) : pivot;
    return false;
  }

  /// (f) as (T + s alpha Phi_q^T Phi_q) dx = -s (M a + Phi_q^T lambda - Q) - s alpha Phi_q^T Phi.
  /// With the Phi_q of the factorisation on the penalty, an old factorisation converges like any
  /// modified Newton iteration; with the current Phi_q it would not for large penalties.
  void solve_increment(const Scheme& k, const Iterate& it) noexcept {
    assert(rhs_.size() == x_.size() && lambda_.size() == f_.constraints());
    delta_ = -k.s * rhs_;
    if (f_.constraints() == 0) {
      f_.solve(delta_, newton_slot);
      signals_.correct(delta_);
      return;
    }
    const VecX& phi = f_.constraint_values();
    f_.solve(delta_, phi, it.penalty, work_, newton_slot);
    signals_.correct(delta_, work_);
    // (h), the multiplier consistent with this solution. Evaluating Phi(q) after the update instead
    // would add the curvature of the constraints, alpha O(dx^2), to the multipliers.
    lambda_ += it.alpha * work_;
  }

  /// Geometric convergence: the remaining error is increment * rate / (1 - rate). Only a rate
  /// measured in this step is used: the next step may reach a stop or a contact.
  void measure(Iterate& it, StepAttempt& report) noexcept {
    const double last = it.increment;
    report.increment = it.increment = largest(delta_);
    ++report.iterations;
    const double rate = report.iterations > 1 && last > 0.0 ? it.increment / last : 1.0;
    it.error = rate < 0.5 ? it.increment * rate / (1.0 - rate) : it.increment;
    if (report.iterations > 1 && last > 0.0 && !it.renew)
      reuse_.contraction = rate < 1.0 ? rate : 1.0;  // also if it is not a number
  }

  bool is_converged(const StepAttempt& report, double error) const noexcept {
    if (loads_.needed() && report.iterations < LoadIteration::least_iterations) return false;
    // An increment below the tolerance leaves a much smaller error; a predicted error below a
    // fiftieth of the tolerance needs no further increment to confirm it.
    const bool small = report.increment < options_.tolerance && error < options_.tolerance;
    return (small || error < 0.02 * options_.tolerance) &&
           report.position_violation < options_.position_tolerance;
  }

  bool project(const Scheme& k, StepAttempt& report) noexcept;
  bool solve_accelerations(const State&, const Scheme&, double penalty, double enough) noexcept;
  bool iterate_accelerations(double s, double penalty, double enough) noexcept;

  void project_velocities(double penalty, StepAttempt& report) noexcept;
  /// One pass: z -= W^-1 Phi_q^T penalty rate, and the remaining rate.
  void correct(VecX& z, double penalty) noexcept {
    assert(penalty > 0.0 && z.size() == delta_.size());
    delta_.setZero();
    f_.solve(delta_, rate_, penalty, work_, projection_slot);
    z += delta_;
    f_.constraint_increments(delta_, increments_);
    rate_ += increments_;
  }

  /// Largest magnitude; NaN if any entry is.
  static double largest(const VecX& x) noexcept {
    double m = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double v = std::abs(x[i]);
      if (std::isnan(v)) return v;
      if (v > m) m = v;
    }
    return m;
  }
  static int index_of_largest(const VecX& x) noexcept {
    int k = -1;
    if (x.size() > 0) x.cwiseAbs().maxCoeff(&k);
    return k;
  }

  F& f_;
  SignalUpdate<F> signals_;
  LoadIteration loads_;
  VecX q_, x_, v_, a_, a_alg_, rhs_, delta_, v_hat_, a_hat_;
  VecX lambda_, rate_, work_, increments_;
  VecX z_hat_;  ///< of the states of elements
};

}  // namespace floatframe

// The remaining member functions.
#include "floatframe/integrator/prediction.hpp"
#include "floatframe/integrator/projections.hpp"
#include "floatframe/integrator/restart.hpp"

namespace floatframe {

// Compiled once: all runs of a formulation use the same arithmetic.
extern template class AugmentedLagrangian<RelativeFormulation>;
extern template class AugmentedLagrangian<AbsoluteFormulation>;

}  // namespace floatframe
