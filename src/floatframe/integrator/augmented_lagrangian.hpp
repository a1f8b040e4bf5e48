#pragma once
// Index-3 augmented Lagrangian with mass-orthogonal projections (paper eqs (1), (2); theory section
// 11), written for any formulation F that offers the members listed in relative.hpp ("the
// integrator's view").
//
// Unknown of a step: the increment x of the configuration, q = q_n (+) x (rotation vectors for
// quaternions). With the generalised-alpha family (spectral radius rho; rho = 1 is the plain
// trapezoidal rule of the paper):
//   v = c1 x + v_hat,  a = c2 x + a_hat,  c1 = gamma/(beta h),  c2 = (1-alpha_m)/((1-alpha_f) beta
//   h^2),  s = 1/c2
// Newton:  T dx = -s [M a + Phi_q^T (alpha Phi + lambda) - Q],  T = M + (c1/c2) C + s (K + Phi_q^T
// alpha Phi_q)
//   then q (+)= dx and lambda += alpha (Phi + Phi_q dx), which is alpha Phi(q) but for the
//   curvature of the constraints.
// Projections with the same factorised T (increment form of T v = W v* - s Phi_q^T alpha Phi_t with
// multipliers):
//   v -= T^-1 s Phi_q^T alpha Phi_dot(v),  a -= T^-1 s Phi_q^T alpha Phi_ddot(a), repeated until
//   the tolerance.
// Nothing here allocates after construction, throws or prints. The state is untouched unless the
// step is accepted.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct State {
  double t = 0.0;
  VecX q, v, a;
  VecX a_alg;  ///< the algorithm's acceleration of generalised-alpha (equals a for the trapezoidal
               ///< rule)
  VecX lambda;
};

struct StepOptions {
  double spectral_radius = 1.0;
  double tolerance = 1e-9;
  int max_iterations = 20;
  double position_tolerance = 1e-9;
  double velocity_tolerance = 1e-8;
  double penalty_mass = 1.0;  ///< s alpha [kg]: the penalty grows like 1/h^2
  int max_projections = 12;
  /// > 0: exactly so many Newton iterations a step, accepted whatever their error (bounded work).
  int fixed_iterations = 0;
  /// > 0: no iteration is begun later than this after the start of the step [s of wall clock]; the
  /// step is accepted as it is then.
  double time_budget = 0.0;
};

/// cut_short: accepted before it converged, because `fixed_iterations` or `time_budget` says so.
enum class StepStatus { converged, cut_short, not_converged, singular_tangent, not_finite };

struct StepReport {
  StepStatus status = StepStatus::converged;
  int iterations = 0, factorizations = 0;
  double position_violation = 0.0, velocity_violation = 0.0;
  int coordinate = -1;     ///< with the vanishing pivot or the largest residual
  int constraint = -1;     ///< with the largest violation, if that did not converge
  double increment = 0.0;  ///< the last Newton increment, largest coordinate [m, rad, amplitudes]
  /// The state was replaced by that of the end of the step.
  bool accepted() const noexcept {
    return status == StepStatus::converged || status == StepStatus::cut_short;
  }
};

template <class F>
class AugmentedLagrangian {
 public:
  AugmentedLagrangian(F& formulation, const StepOptions& options)
      : f_(formulation), options_(options) {
    const int nv = f_.velocities(), nc = f_.constraints();
    q_ = VecX::Zero(f_.configurations());
    x_ = v_ = a_ = a_alg_ = rhs_ = delta_ = v_hat_ = a_hat_ = VecX::Zero(nv);
    lambda_ = rate_ = work_ = VecX::Zero(nc);
  }

  /// One step of size h from `state`, which is replaced only if the step converged.
  StepReport step(State& state, double h) noexcept {
    StepReport report;
    const auto begin = options_.time_budget > 0.0 ? Clock::now() : Clock::time_point{};
    const double rho = options_.spectral_radius;
    const bool trapezoidal = rho >= 1.0;
    const double am = trapezoidal ? 0.0 : (2.0 * rho - 1.0) / (rho + 1.0);
    const double af = trapezoidal ? 0.0 : rho / (rho + 1.0);
    const double gamma = trapezoidal ? 0.5 : 0.5 + af - am;
    const double beta = trapezoidal ? 0.25 : 0.25 * (gamma + 0.5) * (gamma + 0.5);
    const double c1 = gamma / (beta * h);
    const double c2 = (1.0 - am) / ((1.0 - af) * beta * h * h);
    const double s = 1.0 / c2;
    const double alpha = options_.penalty_mass / s;

    // a_alg_{n+1} = (x - h v_n - h^2 (1/2 - beta) a_alg_n) / (beta h^2)
    // a = [(1 - am) a_alg_{n+1} + am a_alg_n - af a_n] / (1 - af),  v = v_n + h (1 - gamma) a_alg_n
    // + h gamma a_alg_{n+1}
    const double base = 1.0 / (beta * h * h);
    v_hat_ = state.v + (h * (1.0 - gamma)) * state.a_alg;
    v_hat_ -= (h * gamma * base) * (h * state.v + (h * h * (0.5 - beta)) * state.a_alg);
    a_hat_ = (-(1.0 - am) * base) * (h * state.v + (h * h * (0.5 - beta)) * state.a_alg);
    a_hat_ += am * state.a_alg - af * state.a;
    a_hat_ /= (1.0 - af);

    // Predictor: the trapezoidal step of each coordinate as if it were an oscillator of its own
    // (frequency 0 for rigid coordinates). A Taylor step would throw modes with omega h >> 1 far
    // away.
    const VecX& omega2 = f_.own_frequencies_squared();
    for (Eigen::Index i = 0; i < x_.size(); ++i)
      x_[i] = (h * state.v[i] + 0.5 * h * h * state.a_alg[i]) / (1.0 + 0.25 * h * h * omega2[i]);
    lambda_ = state.lambda;
    double increment = 0.0;
    bool converged = false;
    while (true) {
      f_.retract(state.q, x_, q_);
      v_ = c1 * x_ + v_hat_;
      a_ = c2 * x_ + a_hat_;
      f_.positions(state.t + h, q_);
      f_.velocities(v_);
      const VecX& phi = f_.constraint_values();
      report.position_violation = largest(phi);
      if (report.iterations > 0) {
        converged = increment < options_.tolerance &&
                    report.position_violation < options_.position_tolerance;
        if (!std::isfinite(increment) || !std::isfinite(report.position_violation)) {
          report.status = StepStatus::not_finite;
          return report;
        }
        if (options_.fixed_iterations > 0) {
          if (report.iterations >= options_.fixed_iterations) {
            if (!converged) report.status = StepStatus::cut_short;
            break;
          }
          converged = false;
        }
        if (converged) break;
        if (options_.time_budget > 0.0 && elapsed(begin) > options_.time_budget) {
          report.status = StepStatus::cut_short;
          break;
        }
        if (options_.fixed_iterations == 0 && report.iterations >= options_.max_iterations) {
          report.status = StepStatus::not_converged;
          if (increment >= options_.tolerance)
            report.coordinate = worst_coordinate();
          else
            report.constraint = index_of_largest(phi);
          return report;
        }
      }
      f_.dynamics();
      f_.residual(a_, lambda_, alpha, rhs_);
      const int pivot = f_.factorize(1.0, c1 / c2, s, alpha);
      ++report.factorizations;
      if (pivot >= 0) {
        report.status = StepStatus::singular_tangent;
        report.coordinate = pivot;
        return report;
      }
      delta_ = -s * rhs_;
      f_.solve(delta_);
      // The multiplier that belongs to this solution: lambda + alpha (Phi + Phi_q dx). Taking
      // Phi(q) after the update instead would feed the curvature of the constraints, alpha O(dx^2),
      // into the multipliers.
      f_.constraint_increments(delta_, work_);
      work_ += phi;
      lambda_ += alpha * work_;
      f_.advance(x_, delta_);
      report.increment = increment = largest(delta_);
      ++report.iterations;
    }

    if (f_.constraints() > 0) {
      constexpr double stiffness = 1e-2;
      const int pivot = f_.factorize(1.0, 0.0, stiffness * s, alpha / stiffness);
      ++report.factorizations;
      if (pivot >= 0) {
        report.status = StepStatus::singular_tangent;
        report.coordinate = pivot;
        return report;
      }
      project(s * alpha, report);
    }
    a_alg_ = base * (x_ - h * state.v - (h * h * (0.5 - beta)) * state.a_alg);
    state.t += h;
    state.q.swap(q_);
    state.v.swap(v_);
    state.a.swap(a_);
    if (trapezoidal)
      state.a_alg = state.a;
    else
      state.a_alg.swap(a_alg_);
    state.lambda.swap(lambda_);
    return report;
  }

  const StepOptions& options() const noexcept { return options_; }

 private:
  using Clock = std::chrono::steady_clock;
  static double elapsed(Clock::time_point begin) noexcept {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void project(double weight, StepReport& report) noexcept {
    for (int pass = 0; pass < options_.max_projections; ++pass) {
      f_.constraint_rates(rate_);
      report.velocity_violation = largest(rate_);
      if (report.velocity_violation < 0.1 * options_.velocity_tolerance) break;
      work_ = -weight * rate_;
      f_.constraint_forces(work_, delta_);
      f_.solve(delta_);
      v_ += delta_;
      f_.velocities(v_);
    }
    double first = 0.0;
    for (int pass = 0; pass < options_.max_projections; ++pass) {
      f_.constraint_accelerations(a_, rate_);
      const double violation = largest(rate_);
      if (pass == 0) first = violation;
      if (violation < 1e-6 + 1e-9 * first || (pass > 3 && violation > 0.5 * first)) break;
      work_ = -weight * rate_;
      f_.constraint_forces(work_, delta_);
      f_.solve(delta_);
      a_ += delta_;
    }
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
  int worst_coordinate() const noexcept { return index_of_largest(delta_); }

  F& f_;
  StepOptions options_;
  VecX q_, x_, v_, a_, a_alg_, rhs_, delta_, v_hat_, a_hat_, lambda_, rate_, work_;
};

}  // namespace floatframe
