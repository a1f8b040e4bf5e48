#pragma once
// Implementation of a Simulation: the part that is independent of the formulation, and its
// interface to the part that is not. A few virtual calls per step, none within.
#include <exception>

#include "floatframe/model/input_value.hpp"
#include "floatframe/simulation/simulation_memory.hpp"
#include "floatframe/simulation/stepping.hpp"

namespace floatframe {

class Simulation::Engine {
 public:
  Engine(const Model& model, const SimulationDescription& options);
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const Model& model() const noexcept { return model_; }
  const SimulationDescription& options() const noexcept { return o_; }
  double time() const noexcept { return row_[0]; }
  std::span<const double> inputs() const noexcept { return inputs_; }
  std::span<const double> outputs() const noexcept {
    return std::span<const double>(row_).subspan(1);
  }

  StepReport step() noexcept { return made(grid().next()); }
  StepReport step(double size) noexcept { return made(grid().of_size(size, time())); }
  std::string failure();
  void set_input(std::size_t index, double value);
  void on_force(ForceCallback callback);
  SimulationState save();
  void restore(const SimulationState& state);
  /// Throws InputError while the force callback runs.
  void require_idle(const char* what) const;

  virtual const StartReport& start_report() const noexcept = 0;
  virtual StepCounters counters() const noexcept = 0;
  virtual SystemState state() = 0;

 protected:
  /// Coordinate or constraint of a failed attempt, as an index into `owners_`; -1: unknown.
  struct Place {
    StepStatus status = StepStatus::completed;
    int owner = -1;
    double time = 0.0;  ///< end of the accepted part [s]
  };
  virtual const TimeGrid& grid() const noexcept = 0;
  /// Makes a step and samples at its end. False if it failed.
  virtual bool advance(const PlannedStep& step) noexcept = 0;
  virtual Place place() const noexcept = 0;
  virtual const StepAttempt& attempt() const noexcept = 0;
  /// As a sentence, for the step that has just failed.
  virtual std::string sentence() = 0;
  virtual void inputs_to_formulation() noexcept = 0;
  virtual void collect(SimulationState::Data& out) const = 0;
  virtual void apply(const SimulationState::Data& data) = 0;

  // Set up by the derived class.
  std::vector<std::string> owners_;  ///< of coordinates, then constraints, then forces
  std::vector<double> row_;          ///< time and outputs
  std::vector<double> inputs_;

 private:
  StepReport made(const PlannedStep& step) noexcept;
  StepStatus call_back(std::string_view& where) noexcept;
  StepReport refused(StepStatus status, std::string_view where = {}) noexcept;
  const std::string& fingerprint();
  std::shared_ptr<SimulationState::Data> present();
  std::string complaint(const SimulationState::Data& given, const SimulationState::Data& own);

  const Model model_;
  const SimulationDescription o_;
  bool failed_ = false, busy_ = false;
  StepReport last_;
  ForceCallback callback_;
  std::vector<double> wanted_;  ///< by the callback
  std::vector<std::string> input_owners_;
  double refused_value_ = 0.0;  ///< step size or value of an input
  std::exception_ptr thrown_;
  std::string sentence_, fingerprint_;
};

}  // namespace floatframe
