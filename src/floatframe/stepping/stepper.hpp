#pragma once
// Makes the steps of a model: its start, the grid of its times, attempts of the integrator divided
// at edges and corners and into substeps, and outputs. The loops of `run`, `Simulation`, real time
// and `bench` use it, so that all of them start in the same way and make the same steps, bit for
// bit; they differ in their tasks between steps: sampling, monitoring, pacing, measuring. After
// construction only `failure`, `system_state` and `memory` allocate.
//
//   advance     one step of the grid
//   cover       its attempts: substeps where one does not converge
//   crossings   times at which formulas cross zero in it (crossings.cpp)
//   part        one attempt, divided at corners (corner_steps.hpp) and edges (edge_locator.hpp)
#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/integrator/integrator.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/reactions/reaction_solver.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/stepping/corner_steps.hpp"
#include "floatframe/stepping/edge_locator.hpp"
#include "floatframe/stepping/energies.hpp"
#include "floatframe/stepping/explicit_move.hpp"
#include "floatframe/stepping/samples.hpp"
#include "floatframe/stepping/step_report.hpp"
#include "floatframe/stepping/time_grid.hpp"

namespace floatframe {

/// Options of a loop in addition to those of the model.
struct StepLimits {
  double duration = TimeGrid::endless;  ///< of the grid [s]
  std::optional<double> min_step = {};  ///< smallest substep [s]; else that of the options
  int fixed_iterations = 0;             ///< see StepOptions
  double time_budget = 0.0;             ///< see StepOptions [s]
  bool bounded = false;                 ///< steps are not divided at edges and corners
  bool until = false;                   ///< the steps end where `until` of the options says
};

/// Everything that determines the next steps and outputs, bit for bit, except the inputs.
struct StepperMemory {
  /// Of the grid.
  double base = 0.0;
  std::int64_t since_base = 0;
  State state;
  std::vector<double> spring_angles;         ///< turns of joint springs
  std::vector<std::int64_t> force_branches;  ///< held branches; empty unless edges are located
  TangentReuse tangent_reuse;
  std::vector<FollowedOutput> outputs;
  std::vector<double> inputs;  ///< consistent with the accelerations of the state
  StepCounters counters;
};

class Stepper {
 public:
  /// Finds the start state; see InitialisedModel for its requirements and exceptions.
  Stepper(const Model& model, const SimulationDescription& options, const StepLimits& limits = {});
  /// Another system at the start of `found`, which must outlive it: the search is not repeated.
  Stepper(const Stepper& found, double duration);
  /// Goes on where `before` is, which must outlive it only for this call, with a model of the same
  /// structure and other numbers: accelerations and multipliers fit the new forces, as they do
  /// after inputs have jumped. Throws InputError if the structure is another one.
  Stepper(const Model& changed, const SimulationDescription& options, const Stepper& before);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  const Model& model() const noexcept { return start_.model(); }
  const StartReport& start_report() const noexcept { return start_.report(); }
  const StepOptions& step_options() const noexcept { return step_options_; }
  double begin() const noexcept { return start_.state().t; }  ///< [s]
  Formulation& formulation() noexcept { return f_; }
  const Formulation& formulation() const noexcept { return f_; }
  const TimeGrid& grid() const noexcept { return grid_; }

  /// The next step of the grid. Returns false if it failed: the formulation then remains at the
  /// failed iteration for diagnosis; the state is that of the last accepted substep, or the one
  /// before the step if the function of an element has thrown.
  bool advance() noexcept { return advance(grid_.next()); }
  /// The last step was shortened to the instant at which the formula `until` crosses zero.
  bool ended() const noexcept { return ended_; }
  /// A step planned by `grid()`. A step longer than those of the grid is not divided into more
  /// parts than one of them: its cost is bounded.
  bool advance(const PlannedStep& step) noexcept;

  const State& state() const noexcept { return state_; }
  /// The last attempt at a step, and the multipliers of the last accepted one, consistent with its
  /// accelerations.
  const StepAttempt& last() const noexcept { return last_; }
  const VecX& reactions() const noexcept { return integrator_->reactions(); }
  const StepCounters& counters() const noexcept { return counters_; }
  /// True if the function of an element has thrown, in the last step or a sample after it. Steps
  /// then fail.
  bool has_thrown() noexcept;
  /// The functions of programs are among the laws.
  bool may_throw() const noexcept { return may_throw_; }
  /// Returns to the state before the last step, for a law that has thrown in the sample after it.
  void undo() noexcept;
  /// Index of the force element with the largest force at the last evaluation; -1: there is none.
  int largest_force() const noexcept;

  /// Where steps are divided at corners of functions of time.
  std::span<const TimeCorner> corners() const noexcept;
  /// Called where forces jump: at edges and corners that steps are divided at, before and after
  /// them, and after inputs have jumped.
  void set_edge_watch(const EdgeWatch& watch) noexcept;

  /// Time and outputs at the present state; brings the formulation there. Outputs count turns from
  /// one sample to the next.
  void sample(double* row) noexcept;
  /// Outputs by formulas, and `until`, that had no value at a sample: a sentence about the first
  /// one, without its full stop; empty: there is none.
  std::string undefined_outputs() const;
  /// If many steps had more edges than are looked for: a sentence without its full stop; empty: no.
  std::string crowded_edges() const;
  /// At the present state; brings the formulation there.
  Energies energies() noexcept;
  /// The cause of the last failed step, as a sentence. Moves the formulation.
  std::string failure();
  /// By the names of joints and bodies; `joints` has followed the steps. Brings the formulation to
  /// the present state.
  SystemState system_state(JointFollower& joints);

  StepperMemory memory() const;
  /// `m` must be of the same model and options.
  void set_memory(const StepperMemory& m);
  /// Returns to the start.
  void restart() { set_memory(first_); }

 private:
  void begin_at_start(bool locate_edges);
  void fit_start();
  void find_corners(const SimulationDescription& options, const StepLimits& limits);
  void locate_corners(const std::vector<TimeCorner>& corners);
  void prepare_reactions();

  /// What a step changes, kept until it is made if the function of an element may throw or a
  /// formula may cross zero.
  struct Before {
    State state;
    std::vector<double> angles;
    std::vector<std::int64_t> branches;
    std::vector<FollowedOutput> outputs;
    double base = 0.0;
    std::int64_t since_base = 0;  ///< of the grid
    TangentReuse tangent_reuse;
    std::vector<double> inputs;
    StepCounters counters;
  };
  void keep(Before& before) const noexcept;

  /// A formula, of an output or `until`, and its memory among those of outputs.
  struct WatchedFormula {
    const Output* output;
    std::size_t memory;
    double value = 0.0, at = 0.0;  ///< at the end of the step; time of the crossing [s]
    bool crosses = false;          ///< in the step
  };
  void watch_formulas();
  bool look_at_formulas() noexcept;
  void note_crossings() noexcept;
  double value_of(const WatchedFormula& w) noexcept;
  bool look_for_crossings(const PlannedStep& step) noexcept;
  double crossing_in(const WatchedFormula& w, double h, double end) noexcept;
  double sampled_instant(double low, double high) const noexcept;
  void return_to_begin() noexcept;
  bool reach(double dt, double h) noexcept;

  bool cover(double h) noexcept;
  StepAttempt part(double h, bool may_meet_corner) noexcept;
  void hold_branches() noexcept;
  void take_inputs(double h) noexcept;
  void sample_elements(double h) noexcept;
  bool take_ticks() noexcept;
  /// With what readers need, at the present state.
  const SystemMotion& present_motion(MotionNeeds needs) noexcept;
  void take_samples() noexcept;
  void count(const StepAttempt& attempt) noexcept;

  // What `failure` is made of.
  std::string step_failure();
  std::string undefined_formula();
  std::string singular_position();
  std::string overflow();
  std::string unreachable_tolerance() const;
  double smallest() const noexcept;  ///< last substep that was attempted [s]

  InitialisedModel start_;
  Formulation& f_;
  StepOptions step_options_;
  double min_step_;  ///< [s], of steps of the grid
  std::unique_ptr<Integrator> integrator_;
  std::optional<EdgeLocator> locator_;
  std::optional<CornerSteps> corners_;
  EdgeWatch watch_;
  InputUse input_use_ = InputUse::held;
  State state_;
  double least_ = 0.0, asked_ = 0.0;    ///< smallest substep and size of the last step [s]
  std::vector<SampleTicks> ticks_;      ///< of sampled elements
  double ticked_ = -TimeGrid::endless;  ///< the last of them in this step [s]
  bool undefined_ = false;              ///< one of them has taken what is not a number
  StepAttempt last_;
  StepCounters counters_;
  std::vector<FollowedOutput> outputs_;
  std::vector<double> inputs_;  ///< those of the last step
  std::optional<Before> before_;
  MotionNeeds needs_;  ///< of the outputs
  Samples samples_;
  std::vector<WatchedFormula> watched_;  ///< `until` last
  MotionNeeds watched_needs_;
  std::optional<ExplicitMove> move_;
  VecX a_end_, zd_end_;  ///< accelerations and rates at the end of the whole step
  bool may_throw_ = false, until_ = false, bounded_ = false, ended_ = false;
  std::optional<ReactionSolver> reactions_;  ///< if an output needs them
  TimeGrid grid_;
  StepperMemory first_;
};

}  // namespace floatframe
