#pragma once
// Implementation of a Simulation: its stepper, inputs, outputs, callback and saved states.
#include <exception>

#include "floatframe/model/input_value.hpp"
#include "floatframe/stepping/simulation_memory.hpp"
#include "floatframe/stepping/step_observer.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

class Simulation::Engine {
 public:
  Engine(const Model& model, const SimulationDescription& options);
  /// Goes on where `before` is, with a model of the same structure; takes its numbers over.
  Engine(const Model& changed, Engine& before);
  ~Engine() {
    if (observer_) observer_->end();
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const Model& model() const noexcept { return model_; }
  const SimulationDescription& options() const noexcept { return o_; }
  double time() const noexcept { return row_[0]; }
  std::span<const double> inputs() const noexcept { return inputs_; }
  std::span<const double> outputs() const noexcept {
    return std::span<const double>(row_).subspan(1);
  }

  const TimeGrid& grid() const noexcept { return steps_.grid(); }
  StepReport make(const PlannedStep& step) noexcept;
  std::string failure();
  const std::exception_ptr& thrown() const noexcept {
    return steps_.formulation().thrown().exception;
  }
  void set_input(std::size_t index, double value);
  void on_force(ForceCallback callback);
  SimulationState save();
  void restore(const SimulationState& state);
  std::vector<double> state_values(std::span<const StateName> names);
  void set_state(std::span<const GivenState> given);
  void reset();
  void observe(StepObserver* observer);
  /// Tells the observer where steps go on from.
  void begin_observation(StepsBegin why);
  /// True if no step of the other model differs from those of this one.
  bool steps_as(const Model& other);
  /// Throws InputError while the force callback runs.
  void require_idle(const char* what) const;

  const StartReport& start_report() const noexcept { return steps_.start_report(); }
  StepCounters counters() const noexcept { return steps_.counters(); }
  SystemState state();

 private:
  StepStatus call_back(std::string_view& where) noexcept;
  StepReport refused(StepStatus status, std::string_view where = {}) noexcept;
  const std::string& fingerprint();
  std::shared_ptr<SimulationState::Data> present();
  std::string complaint(const SimulationState::Data& given, const SimulationState::Data& own);

  void name_owners();
  void sample() noexcept;
  /// The end of a report about a step that failed.
  void explain(StepReport& report) const noexcept;
  void inputs_to_formulation() noexcept { steps_.formulation().set_inputs(inputs_); }
  /// Steps may go on.
  void go_on() {
    failed_ = false;
    last_ = StepReport();
    sentence_.clear();
  }

  const Model model_;
  const SimulationDescription o_;
  Stepper steps_;
  JointFollower joints_;
  std::vector<std::string> owners_;  ///< of coordinates, then constraints, then elements
  std::vector<double> row_;          ///< time and outputs
  std::vector<double> row_before_;   ///< those before the step
  std::vector<double> inputs_;
  bool failed_ = false, busy_ = false;
  StepReport last_;
  ForceCallback callback_;
  std::vector<double> wanted_;  ///< by the callback
  std::vector<std::string> input_owners_;
  double refused_value_ = 0.0;  ///< step size or value of an input
  std::exception_ptr thrown_;
  std::string sentence_, fingerprint_;
  std::vector<double> first_joints_;  ///< numbers of `joints_` at the start
  StepObserver* observer_ = nullptr;
};

}  // namespace floatframe
