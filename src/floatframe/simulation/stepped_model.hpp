#pragma once
// A model in one formulation that makes steps: its start, its runner, the grid of its times. The
// loops of `run`, `Simulation`, real time and `bench` use it, so that all of them start in the same
// way and make the same steps, bit for bit; they differ in their tasks between steps: sampling,
// monitoring, pacing, measuring. After construction only `failure`, `system_state` and `memory`
// allocate.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/simulation/energies.hpp"
#include "floatframe/simulation/runner.hpp"
#include "floatframe/simulation/start_up.hpp"
#include "floatframe/simulation/system_state.hpp"
#include "floatframe/simulation/time_grid.hpp"

namespace floatframe {

/// Options of a loop in addition to those of the model.
struct StepLimits {
  double duration = TimeGrid::endless;  ///< of the grid [s]
  std::optional<double> min_step = {};  ///< smallest substep [s]; else that of the options
  int fixed_iterations = 0;             ///< see StepOptions
  double time_budget = 0.0;             ///< see StepOptions [s]
  bool bounded = false;                 ///< steps are not divided at edges and corners
};

/// Everything that determines the next steps, except the inputs.
struct SteppedMemory {
  /// Of the grid.
  double base = 0.0;
  std::int64_t since_base = 0;
  State state;
  std::vector<double> spring_angles;         ///< turns of joint springs
  std::vector<std::int64_t> force_branches;  ///< held branches; empty unless edges are located
  RunnerMemory runner;
};

/// F: RelativeFormulation or AbsoluteFormulation.
template <class F>
class SteppedModel {
 public:
  /// Finds the start state; see InitialisedModel for its requirements and exceptions.
  SteppedModel(const Model& model, const SimulationDescription& options,
               const StepLimits& limits = {});
  /// Another system at the start of `found`, which must outlive it: the search is not repeated.
  SteppedModel(const SteppedModel& found, double duration);
  SteppedModel(const SteppedModel&) = delete;
  SteppedModel& operator=(const SteppedModel&) = delete;

  const Model& model() const noexcept { return start_.model(); }
  const StartReport& start_report() const noexcept { return start_.report(); }
  const StepOptions& step_options() const noexcept { return step_options_; }
  double begin() const noexcept { return start_.state().t; }  ///< [s]
  F& formulation() noexcept { return f_; }
  const F& formulation() const noexcept { return f_; }
  const TimeGrid& grid() const noexcept { return grid_; }

  /// The next step of the grid. Returns false if it failed: the formulation then remains at the
  /// failed iteration for diagnosis; the state is the last accepted one.
  bool advance() noexcept { return advance(grid_.next()); }
  /// A step planned by `grid()`. A step longer than those of the grid is not divided into more
  /// parts than one of them: its cost is bounded.
  bool advance(const PlannedStep& step) noexcept;

  const State& state() const noexcept { return runner_.state(); }
  /// The last attempt at a step, and the multipliers of the last accepted one, consistent with its
  /// accelerations.
  const StepAttempt& last() const noexcept { return runner_.last(); }
  const VecX& reactions() const noexcept { return runner_.reactions(); }
  const StepCounters& counters() const noexcept { return runner_.counters(); }
  /// Index of the force element with the largest force at the last evaluation; -1: there is none.
  int largest_force() const noexcept { return runner_.largest_force(); }

  /// Where steps are divided at corners of functions of time.
  std::span<const TimeCorner> corners() const noexcept { return runner_.corners(); }
  /// Called where forces jump: at edges and corners that steps are divided at, before and after
  /// them, and after inputs have jumped.
  void set_edge_watch(const EdgeWatch& watch) noexcept { runner_.set_edge_watch(watch); }

  /// Time and outputs at the present state; brings the formulation there. Outputs count turns from
  /// one sample to the next.
  void sample(double* row) noexcept;
  /// At the present state; brings the formulation there.
  Energies energies() noexcept;
  /// The cause of the last failed step, as a sentence. Moves the formulation.
  std::string failure();
  /// By the names of joints and bodies; `joints` has followed the steps. Brings the formulation to
  /// the present state.
  SystemState system_state(JointFollower& joints);

  SteppedMemory memory() const;
  /// `m` must be of the same model and options.
  void set_memory(const SteppedMemory& m);
  /// Returns to the start.
  void restart() { set_memory(first_); }

 private:
  void begin_at_start(bool locate_edges);
  void find_corners(const SimulationDescription& options, const StepLimits& limits);
  void prepare_reactions();

  InitialisedModel start_;
  F& f_;
  StepOptions step_options_;
  double min_step_;  ///< [s]
  Runner<F> runner_;
  std::optional<ReactionSolver> reactions_;  ///< if an output needs them
  TimeGrid grid_;
  SteppedMemory first_;
};

extern template class SteppedModel<RelativeFormulation>;
extern template class SteppedModel<AbsoluteFormulation>;

}  // namespace floatframe
