#pragma once
// State, options and result of an integrator step.
#include <limits>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct State {
  double t = 0.0;  ///< [s]
  VecX q;          ///< configuration, nq numbers
  VecX v, a;       ///< velocities and accelerations, nv numbers
  /// The algorithm's acceleration of generalised-alpha, (a) of augmented_lagrangian.hpp; equals a
  /// for the trapezoidal rule.
  VecX a_alg;
  VecX lambda;  ///< multipliers, nc numbers [N]
  /// States of elements, their rates and the algorithm's rates (state_scheme.hpp); equal for the
  /// trapezoidal rule.
  VecX z, zd, zd_alg;
};

struct StepOptions {
  double spectral_radius = 1.0;      ///< rho, 1: trapezoidal rule
  double tolerance = 1e-9;           ///< of the increment of a step [m, rad, amplitudes]
  int max_iterations = 20;           ///< Newton iterations per attempt
  double position_tolerance = 1e-9;  ///< of Phi [m]
  double velocity_tolerance = 1e-8;  ///< of Phidot [m/s]
  double penalty_mass = 1.0;         ///< s alpha [kg]: the penalty grows like 1/h^2
  int max_projections = 12;
  /// > 0: exactly so many Newton iterations per step, accepted whatever their error (bounded work).
  int fixed_iterations = 0;
  /// > 0: no iteration begins later than this after the start of the step [s of wall clock]; the
  /// step is then accepted as it is.
  double time_budget = 0.0;
  /// Larger accelerations in a restart belong to massless directions [m/s2, rad/s2, amplitudes/s2].
  double largest_acceleration = 1e7;
};

inline bool are_valid(const StepOptions& o) noexcept {
  return o.spectral_radius >= 0.0 && o.spectral_radius <= 1.0 && o.tolerance > 0.0 &&
         o.max_iterations > 0 && o.position_tolerance >= 0.0 && o.velocity_tolerance >= 0.0 &&
         o.penalty_mass > 0.0 && o.max_projections >= 0 && o.fixed_iterations >= 0 &&
         o.time_budget >= 0.0;
}
/// nq, nv and nc of a formulation.
inline bool has_sizes(const State& s, Eigen::Index nq, Eigen::Index nv, Eigen::Index nc) noexcept {
  return s.q.size() == nq && s.v.size() == nv && s.a.size() == nv && s.a_alg.size() == nv &&
         s.lambda.size() == nc;
}

/// cut_short: accepted before convergence, because of `fixed_iterations` or `time_budget`.
/// states_not_solved: those of an element, at an iterate.
enum class AttemptStatus {
  converged,
  cut_short,
  not_converged,
  singular_tangent,
  not_finite,
  states_not_solved,
  law_failed  ///< the function of an element has thrown (`Formulation::thrown`)
};

/// Result of one attempt at a step.
struct StepAttempt {
  AttemptStatus status = AttemptStatus::converged;
  int iterations = 0, factorizations = 0;
  double position_violation = 0.0, velocity_violation = 0.0;
  int coordinate = -1;     ///< with the vanishing pivot or the largest residual
  int constraint = -1;     ///< with the largest violation, if the constraints did not converge
  int element = -1;        ///< whose states are not solved, or that has no value
  double increment = 0.0;  ///< the last Newton increment, largest coordinate [m, rad, amplitudes]
  double size = 0.0;       ///< of the step [s]
  /// Sum of the logarithms of the pivots of the projection metric with the full penalty: it drops
  /// where constraints become dependent. NaN: there are no projections.
  double log_pivots = std::numeric_limits<double>::quiet_NaN();
  /// The largest one of the loads of friction (load_iteration.hpp): 0 without any.
  double load_contraction = 0.0;
  /// True if the state was replaced by the state at the end of the step.
  bool accepted() const noexcept {
    return status == AttemptStatus::converged || status == AttemptStatus::cut_short;
  }
};

/// Data that the next step takes over from the last one in addition to the state.
struct TangentReuse {
  double valid_at = std::numeric_limits<double>::quiet_NaN();  ///< end of the last step [s]
  double contraction = 0.1;  ///< convergence rate with a reused tangent
};

}  // namespace floatframe
