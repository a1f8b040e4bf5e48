#pragma once
// A model one step at a time: set inputs, make a step, read outputs, save all that decides the next
// step and go back to it.
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
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model/system_state.hpp"
#include "floatframe/simulation/simulation_state.hpp"
#include "floatframe/simulation/start_report.hpp"
#include "floatframe/simulation/step_report.hpp"

namespace floatframe {

/// Each that is set replaces the one in `model.simulation`.
struct SimulationOptions {
  std::optional<double> step = {};  ///< [s]
  std::optional<Coordinates> coordinates = {};
  std::optional<InertiaMethod> inertia = {};
  std::optional<Start> start = {};
  std::shared_ptr<const SystemState> state = {};  ///< where Start::state starts
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
  /// Finds the start: loops closed, or the equilibrium, or the state that is given. Keeps a copy of
  /// the model. Throws InputError for options that are not valid, RunError if the start cannot be.
  explicit Simulation(const Model& model, const SimulationOptions& options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;  // hold it by a pointer where it must move
  Simulation& operator=(const Simulation&) = delete;

  const Model& model() const noexcept;
  /// Those of the model with what was replaced.
  const SimulationDescription& options() const noexcept;
  const StartReport& start_report() const noexcept;

  /// One step of the size of the options, in substeps if need be. Does not allocate. After a step
  /// that failed, time and outputs are those of the last good step; further steps do nothing until
  /// `restore`.
  StepReport step() noexcept;
  /// One of another size [s]. Steps of the first kind go on from its end.
  StepReport step(double size) noexcept;
  /// Why the last step failed, in a sentence; empty if it did not.
  std::string failure() const;

  double time() const noexcept;  ///< end of the last step [s]
  StepCounters counters() const noexcept;
  /// Coordinates and velocities by the names of joints and bodies: the file of a state, from which
  /// either formulation can start, but not with the same bits.
  SystemState state() const;

  /// In the order of `model().inputs`, and what they are now.
  std::vector<std::string> input_names() const;
  std::span<const double> inputs() const noexcept;
  /// Held over the next step and on. Throws InputError for an unknown input and for a value that is
  /// not finite or outside of its limits (with `clamp`, the nearer limit is taken).
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
  /// change: a force of the user's own is a load, an actuator or a target with an input. They are
  /// held over the whole of the step, also in its substeps. Values are held to the same rules as by
  /// `set_input`. An empty function removes it.
  using ForceCallback =
      std::function<void(double time, std::span<const double> outputs, std::span<double> inputs)>;
  void on_force(ForceCallback callback);

  /// All that decides the next steps; see SimulationState. Throws InputError after a step that
  /// failed.
  SimulationState save() const;
  /// Back, or on, to a saved state, of this simulation or of another one of the same model with the
  /// same options. Throws InputError, and changes nothing, if it is of another model, made with
  /// other options, or not valid. The force callback stays.
  void restore(const SimulationState& state);

 private:
  class Engine;
  template <class F>
  class EngineOf;
  std::unique_ptr<Engine> engine_;
};

}  // namespace floatframe
