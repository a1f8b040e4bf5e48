#pragma once
// The start of every run, independent of the stepping: a model with the start values given by its
// options, a formulation, the start state with loops closed or in equilibrium, accelerations and
// constraint forces, the options of the integrator.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/loops/start_report.hpp"

namespace floatframe {

class InitialisedModel {
 public:
  /// The options must be valid (`require_valid`); the model must outlive this. Throws InputError
  /// for a state of another model, RunError if there is no start state.
  InitialisedModel(const Model& given, const SimulationDescription& options)
      : InitialisedModel(given, options, options.coordinates) {}
  /// In other coordinates than those of the options.
  InitialisedModel(const Model& given, const SimulationDescription& options,
                   Coordinates coordinates);
  /// Another system at the start of `found`, which must outlive it: the search is not repeated.
  InitialisedModel(const InitialisedModel& found);
  /// A model of the same structure with other numbers, at the start of `found`: nothing is searched
  /// for, so that the state fits the new numbers in its positions and velocities alone. Throws
  /// InputError if there are other coordinates, constraints or states.
  InitialisedModel(const Model& changed, const SimulationDescription& options,
                   const InitialisedModel& found);
  InitialisedModel& operator=(const InitialisedModel&) = delete;

  /// The model of the formulation: with the start values of the state, if the run starts from one.
  const Model& model() const noexcept { return changed_ ? *changed_ : given_; }
  Formulation& formulation() noexcept { return *f_; }
  InertiaMethod inertia() const noexcept { return inertia_; }
  const State& state() const noexcept { return state_; }
  /// Another state of the same positions and velocities.
  void move_to(State state) { state_ = std::move(state); }
  const StartReport& report() const noexcept { return report_; }
  /// Other information for the user about the start.
  void add_note(std::string note) { report_.notes.push_back(std::move(note)); }
  const StepOptions& step_options() const noexcept { return step_options_; }
  /// Smallest substep [s].
  double min_step() const noexcept { return min_step_; }

 private:
  const Model& given_;
  std::optional<Model> changed_;
  InertiaMethod inertia_;
  std::unique_ptr<Formulation> f_;
  State state_;
  std::vector<double> spring_angles_;  ///< at the start: the turns that springs count from
  StartReport report_;
  StepOptions step_options_;
  double min_step_;
};

}  // namespace floatframe
