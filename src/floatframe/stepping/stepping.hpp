#pragma once
// A model one step at a time: set inputs, make a step, read outputs, save everything that
// determines the next step and return to it.
//
//   const Model model = load_model("vehicle.yaml");
//   Simulation s(model, {.step = 1e-3});
//   while (s.time() < 8.0) {
//     s.set_input("damper", 300.0);
//     if (const StepReport r = s.step(); !r) throw std::runtime_error(s.failure());
//     z = s.output("chassis.z");
//   }
//
// `run` makes the same steps, bit for bit. A simulation belongs to one thread at a time; several of
// one model may run in several threads.
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/description/state_name.hpp"
#include "floatframe/description/system_state.hpp"
#include "floatframe/loops/start_report.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/stepping/simulation_state.hpp"
#include "floatframe/stepping/step_report.hpp"

namespace floatframe {

class StepObserver;

/// Each option that is set replaces the one in `model.simulation`.
struct SimulationOptions {
  std::optional<double> step = {};  ///< [s]
  std::optional<Coordinates> coordinates = {};
  std::optional<InertiaMethod> inertia = {};
  std::optional<Start> start = {};
  std::shared_ptr<const SystemState> state = {};  ///< initial state for Start::state
  std::optional<double> tolerance = {}, spectral_radius = {};
  std::optional<int> max_iterations = {};
  std::optional<double> min_step = {};  ///< smallest substep [s]; 0: step / 1024
  std::optional<double> penalty = {};
  std::optional<double> position_tolerance = {}, velocity_tolerance = {};  ///< [m], [m/s]
  std::optional<bool> locate_edges = {};
  std::optional<InputUse> input = {};
};

class Simulation {
 public:
  /// Finds the start: loops closed, or the equilibrium, or the given state. Keeps a copy of the
  /// model. Throws InputError for invalid options, RunError if there is no start state.
  explicit Simulation(const Model& model, const SimulationOptions& options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;  // hold it by a pointer where it must move
  Simulation& operator=(const Simulation&) = delete;

  const Model& model() const noexcept;
  /// The options of the model with these replacements.
  const SimulationDescription& options() const noexcept;
  const StartReport& start_report() const noexcept;

  /// One step of the size of the options, in substeps if necessary. Does not allocate, but for a
  /// recording that grows. After a failed step, time and outputs are those of the last accepted
  /// step; further steps have no effect until `restore`, `set_state` or `reset`.
  StepReport step() noexcept;
  /// One step of another size [s]. Steps of the default size continue from its end.
  StepReport step(double size) noexcept;
  /// The cause of the last failed step, as a sentence; empty if it did not fail.
  std::string failure() const;
  /// What the function of a force has thrown in a step that failed by it; else null.
  std::exception_ptr thrown() const noexcept;

  double time() const noexcept;  ///< end of the last step [s]
  StepCounters counters() const noexcept;
  /// Coordinates and velocities by the names of joints and bodies: the content of a state file,
  /// from which either formulation can start, but not bit for bit.
  SystemState state() const;

  /// The present values of these coordinates, amplitudes, states of elements or rates, as `state`
  /// has them, without its cost. Throws InputError for a name that the model does not have.
  std::vector<double> state_values(std::span<const StateName> names) const;
  /// Sets coordinates and amplitudes or their rates at the present time: what is given is met, all
  /// else changes as little as the loops need. States of elements and inputs stay. Steps go on also
  /// where one had failed. Takes as long as a start; `restore` and `reset` take less than a step.
  /// Throws InputError for a name that the model does not have, RunError with the remaining gap if
  /// the loops do not close; nothing is changed then.
  void set_state(std::span<const GivenState> given);
  /// Returns to the start: its time, state, inputs and counters.
  void reset();

  /// In the order of `model().inputs`, and their present values.
  std::vector<std::string> input_names() const;
  std::span<const double> inputs() const noexcept;
  /// Constant over the next step and later ones. Throws InputError for an unknown input and for a
  /// value that is not finite or outside of its limits (with `clamp`, the nearer limit is taken).
  void set_input(std::string_view name, double value);
  void set_input(std::ptrdiff_t index, double value);
  template <std::same_as<std::nullptr_t> T>
  void set_input(T, double value) = delete;

  /// In the order of `model().outputs`, at the end of the last step.
  std::vector<std::string> output_names() const;
  std::span<const double> outputs() const noexcept;
  /// Throw InputError for an unknown output.
  double output(std::string_view name) const;
  double output(std::ptrdiff_t index) const;
  template <std::same_as<std::nullptr_t> T>
  double output(T) const = delete;

  /// Called at the beginning of every step with the time, the outputs and the inputs, which it may
  /// change: a sampled force is a load, an actuator or a target with an input. They are constant
  /// over the whole step, including its substeps: an error of first order, by which stiff forces
  /// gain energy. The element ForceLaw is evaluated in every iteration instead. Values are subject
  /// to the same rules as in `set_input`. An empty function removes it.
  using ForceCallback =
      std::function<void(double time, std::span<const double> outputs, std::span<double> inputs)>;
  void on_force(ForceCallback callback);

  /// Everything that determines the next steps; see SimulationState. Throws InputError after a
  /// failed step.
  SimulationState save() const;
  /// Returns to a saved state, of this simulation or of another one of the same model with the same
  /// options. Throws InputError, and changes nothing, if it is of another model, made with other
  /// options, or not valid. The force callback remains set.
  void restore(const SimulationState& state);

  /// From the next step on the model is `changed`: of the same structure, with other numbers
  /// (stiffnesses, gains, masses, laws, functions of time, ...). Positions, velocities, states of
  /// elements, inputs and options stay; time and outputs are those of the last step until the next
  /// one. A model that steps as the present one changes nothing. States saved before belong to the
  /// old model, states saved from now on to the new one. Allocates. Throws InputError, and changes
  /// nothing, for a model of another structure, after a failed step and during the force callback.
  void change_model(const Model& changed);

  /// For a Recording, one at a time; null: none. Throws InputError if there is one.
  void observe(StepObserver* observer);

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace floatframe
