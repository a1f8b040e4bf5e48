#pragma once
// The report of a step of a simulation, and the totals over all steps.
#include <cstdint>
#include <string_view>

namespace floatframe {

enum class StepStatus : std::uint8_t {
  completed,
  not_converged,     ///< at the smallest substep
  singular_tangent,  ///< a freedom without mass and stiffness
  not_finite,        ///< numbers grew without bounds
  law_failed,        ///< the function of a force threw an exception
  failed_before,     ///< a step after a failed one: no effect
  invalid_step,      ///< a step size that is not positive, or lost in rounding: no effect
  invalid_input,     ///< the force callback returned an invalid value of an input: no effect
  callback_failed,   ///< the force callback threw an exception: nothing done
  busy               ///< called from the force callback: nothing done
};

/// "completed", "not_converged", ...
const char* step_status_name(StepStatus status) noexcept;

struct StepReport {
  StepStatus status = StepStatus::completed;
  /// For a failed step, the place of the failure: "joint 'crank'", "mode 2 of body 'beam'", "input
  /// 'f'". Owned by the simulation.
  std::string_view where;
  double time = 0.0;   ///< reached: the end of the step, or of its accepted part [s]
  int iterations = 0;  ///< Newton iterations of this step
  int factorizations = 0;
  int substeps = 0;                 ///< that it was divided into; 0: made in one
  double position_violation = 0.0;  ///< largest of a constraint at the end [m]
  double velocity_violation = 0.0;  ///< [m/s]
  explicit operator bool() const noexcept { return status == StepStatus::completed; }
};

/// Sums and largest values since the start.
struct StepCounters {
  std::int64_t steps = 0;     ///< requested and completed
  std::int64_t substeps = 0;  ///< by halving of steps that did not converge
  std::int64_t iterations = 0, factorizations = 0;
  std::int64_t edges = 0;               ///< that steps were divided at (`locate_edges`)
  std::int64_t edges_passed = 0;        ///< steps with more edges than are looked for
  std::int64_t corners = 0;             ///< of functions of time, that steps were divided at
  std::int64_t cut_short = 0;           ///< accepted before they had converged (real time)
  double max_position_violation = 0.0;  ///< [m] after steps
  double max_velocity_violation = 0.0;  ///< [m/s] after the projections
  /// Of the loads of joints that friction reads, from iteration to iteration; 0 without any.
  double max_load_contraction = 0.0;
};

}  // namespace floatframe
