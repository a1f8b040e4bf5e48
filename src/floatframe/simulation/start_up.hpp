#pragma once
// The start of every run, whoever makes the steps: a model with the start values that its options
// ask for, a formulation, the state at the start with loops closed or in equilibrium, accelerations
// and constraint forces, the options of the integrator.
#include <optional>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/simulation/start_report.hpp"

namespace floatframe {

/// F: RelativeFormulation or AbsoluteFormulation, whatever the options say of coordinates.
template <class F>
class StartedModel {
 public:
  /// The options must be valid (`require_valid`); the model must outlive this. Throws InputError
  /// for a state of another model, RunError if the start cannot be.
  StartedModel(const Model& given, const SimulationDescription& options);
  StartedModel(const StartedModel&) = delete;
  StartedModel& operator=(const StartedModel&) = delete;

  /// That of the formulation: with the start values of the state, if the run starts from one.
  const Model& model() const noexcept { return changed_ ? *changed_ : given_; }
  F& formulation() noexcept { return f_; }
  const State& state() const noexcept { return state_; }
  const StartReport& report() const noexcept { return report_; }
  const StepOptions& step_options() const noexcept { return step_options_; }
  /// Smallest substep [s].
  double min_step() const noexcept { return min_step_; }

 private:
  const Model& given_;
  std::optional<Model> changed_;
  F f_;
  State state_;
  StartReport report_;
  StepOptions step_options_;
  double min_step_;
};

extern template class StartedModel<RelativeFormulation>;
extern template class StartedModel<AbsoluteFormulation>;

}  // namespace floatframe
