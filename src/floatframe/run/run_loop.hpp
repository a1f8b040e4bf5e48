#pragma once
// One run: its steps, recording and monitoring, its summary, and between steps the output of rows
// and checkpoints.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "floatframe/core/output_error.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/run/forcing.hpp"
#include "floatframe/run/row_block.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/run/run_memory.hpp"
#include "floatframe/run/run_watch.hpp"
#include "floatframe/run/state_layout.hpp"
#include "floatframe/run/step_control.hpp"
#include "floatframe/run/step_times.hpp"
#include "floatframe/run/summary_ends.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

class Run {
 public:
  Run(const Model& given, const SimulationDescription& o, const RunOptions& options,
      const Controller* controller = nullptr)
      : o_(o),
        options_(options),
        steps_(given, o, {.duration = o.duration, .until = o.until != nullptr}),
        planned_(steps_.grid().steps()),
        every_(steps_per_row(o)),
        checkpoint_every_(options.checkpoint && options.checkpoint_every > 0.0
                              ? std::max(1L, std::lround(options.checkpoint_every / o.step))
                              : 0) {
    result_.summary = summary_at_start(steps_, o);
    if (controller && controller->on_step) control_.emplace(steps_, *controller);
    prepare_table();
    if (options.keep_state) joints_.emplace(steps_.model());
    if (options.record && options.watch)
      watch_.emplace(steps_.formulation(), o.step, planned_ / every_);
    if (watch_)
      steps_.set_edge_watch(
          {&*watch_, [](void* watch, const State& state, const VecX& reactions) noexcept {
             static_cast<RunWatch*>(watch)->edge(state, reactions);
           }});
    prepare_states();
  }

  RunResult result() {
    const long report_every = std::max(1L, planned_ / 100);
    bool good = options_.resume ? resume(*options_.resume) : begin();
    while (good && made_ < planned_ && !steps_.ended()) {
      good = go_on() && step() && flush_if_due();
      if (good && options_.progress && made_ % report_every == 0)
        options_.progress(static_cast<double>(made_) / static_cast<double>(planned_));
    }
    finish();
    return std::move(result_);
  }

 private:
  void prepare_table() {
    ResultTable& table = result_.table;
    table.columns.push_back({"time", "s"});
    for (const Output& out : steps_.model().outputs) table.columns.push_back({out.name, out.unit});
    if (!options_.record) return;
    if (options_.rows)
      block_.emplace(table.columns, options_.rows);
    else
      table.data.assign((static_cast<std::size_t>(planned_ / every_) + 3) * table.columns.size(),
                        0.0);
  }

  void prepare_states() {
    if (!options_.record || !options_.states) return;
    states_.emplace(steps_.formulation(), o_.record,
                    watch_ ? watch_->health_columns() : std::vector<HealthColumn>());
    states_every_ = states_every(o_.record, planned_ / every_ + 1);
    state_columns_.resize(static_cast<std::size_t>(states_->layout().columns));
    state_sink_ = [this](const std::vector<Column>&, std::span<const double> numbers) {
      options_.states(states_->layout(), numbers);
    };
    state_block_.emplace(state_columns_, state_sink_);
  }

  bool begin() {
    if (options_.record) sample();
    sample_state(0);
    follow_joints();
    if (watch_) watch_->start(steps_.state());
    sample_health();
    return flush();
  }

  void sample() noexcept {
    ResultTable& table = result_.table;
    double* const row =
        block_ ? block_->next() : table.data.data() + table.columns.size() * rows_++;
    steps_.sample(row);
    if (control_) control_->sampled(row);
  }

  /// The law of a program has thrown in the sample.
  void take_back() noexcept {
    steps_.undo();
    if (block_)
      block_->take_back();
    else
      --rows_;
  }

  bool is_last(long step) const noexcept { return step == planned_ || steps_.ended(); }

  /// After `sample`, which has brought the formulation to the state.
  void sample_state(long step) noexcept {
    state_row_ = nullptr;
    if (!state_block_ || (!is_last(step) && step / every_ % states_every_ != 0)) return;
    state_row_ = state_block_->next();
    states_->sample(steps_.state(), state_row_);
  }

  /// Fills the row begun by `sample_state`, after the step was monitored.
  void sample_health() noexcept {
    if (!state_row_ || !watch_) return;
    watch_->health(steps_.counters(), state_row_ + states_->layout().groups.back().first);
    state_row_ = nullptr;
  }

  /// Returns false if the run is to end here.
  bool go_on() {
    if (!options_.stop || !options_.stop->load(std::memory_order_relaxed)) return true;
    RunSummary& s = result_.summary;
    s.status = "interrupted";
    s.message = fmt::format("interrupted at t = {:.9g} s of {:.9g} s", steps_.state().t,
                            steps_.begin() + o_.duration);
    if (checkpoint_every_ > 0) write_checkpoint();
    return false;
  }

  /// Returns false if the step failed.
  bool step() {
    RunSummary& s = result_.summary;
    const long k = made_ + 1;
    if (control_) control_->before_step(made_);
    const Nanoseconds before = thread_cpu_clock();
    const PlannedStep planned = steps_.grid().next();
    bool good = steps_.advance(planned);
    const bool sampled = good && options_.record && (k % every_ == 0 || is_last(k));
    if (sampled) sample();
    good = good && !steps_.has_thrown();
    if (sampled && !good) take_back();
    const Nanoseconds taken = thread_cpu_clock() - before;
    s.cpu += 1e-9 * static_cast<double>(taken);
    if (good) step_times_.add(taken);
    if (good && sampled) sample_state(k);
    if (good) follow_joints();
    if (good && watch_) {
      watch_->step(steps_.state(), steps_.reactions(), sampled, planned.whole && !steps_.ended());
      watch_->attempt(steps_.state(), steps_.last());
      sample_health();
    }
    if (good) {
      made_ = k;
      return true;
    }
    s.status = "failed";
    s.message = steps_.failure();
    result_.thrown = steps_.formulation().thrown().exception;
    return false;
  }

  void follow_joints() {
    if (!joints_) return;
    kinematics_at(steps_.formulation(), steps_.state());
    joints_->follow(steps_.formulation().motion());
  }

  /// Between steps. Returns false if the data cannot be written.
  bool flush_if_due() {
    if (checkpoint_every_ > 0 && made_ % checkpoint_every_ == 0 && !is_last(made_))
      return write_checkpoint();
    const bool rows = block_ && block_->due(), states = state_block_ && state_block_->due();
    return (!rows && !states) || flush();
  }

  bool write_checkpoint() {
    if (!flush()) return false;
    RunMemory m;
    m.made = made_;
    m.steps = steps_.memory();
    m.cpu = result_.summary.cpu;
    m.step_times = step_times_;
    if (joints_) m.joints = joints_->numbers();
    return written([&] { options_.checkpoint(to_checkpoint(identity(), m, watch_)); });
  }

  bool flush() {
    return written([&] {
      if (block_) block_->hand_over();
      if (state_block_) state_block_->hand_over();
    });
  }

  template <class Write>
  bool written(const Write& write) {
    try {
      write();
      return true;
    } catch (const OutputError& error) {
      block_.reset();  // buffered rows are discarded
      state_block_.reset();
      result_.summary.status = "failed";
      result_.summary.message = fmt::format("at t = {:.9g} s {}", steps_.state().t, error.what());
      return false;
    }
  }

  RunIdentity identity() {
    return run_identity(steps_.model(), o_,
                        {options_.record, watch_.has_value(), joints_.has_value(),
                         states_ ? record_text(o_.record, states_every_) : "none"});
  }

  bool resume(const RunCheckpoint& checkpoint) {
    const RunMemory m =
        from_checkpoint(checkpoint, identity(), steps_.memory(), steps_.formulation(), o_.step,
                        joints_ ? joints_->size() : 0, planned_, watch_);
    made_ = m.made;
    steps_.set_memory(m.steps);
    result_.summary.cpu = m.cpu;
    step_times_ = m.step_times;
    if (joints_) joints_->restore(m.joints, m.steps.state.t);
    return flush();
  }

  void finish() {
    if (block_ || state_block_) flush();
    RunSummary& s = result_.summary;
    result_.table.data.resize(rows_ * result_.table.columns.size());
    if (steps_.ended()) s.crossed_at = steps_.state().t;
    s.step_times = step_times(step_times_);
    write_end(steps_, steps_.begin(), s);
    if (joints_) result_.state = std::make_shared<SystemState>(steps_.system_state(*joints_));
    if (watch_) finish_watch(s);
    warn_of_steps(steps_, s.warnings);
  }

  void finish_watch(RunSummary& s) {
    watch_->finish(steps_.state(), steps_.step_options().spectral_radius, steps_.corners(), s);
    const auto unresolved =
        unresolved_forcing(steps_.model(), o_.step, steps_.begin(), o_.duration, steps_.corners());
    s.warnings.insert(s.warnings.begin(), unresolved.begin(), unresolved.end());
  }

  const SimulationDescription& o_;
  const RunOptions& options_;
  Stepper steps_;
  const long planned_, every_;   ///< sampling interval in planned steps
  const long checkpoint_every_;  ///< steps; 0: no checkpoints
  long made_ = 0;                ///< steps
  RunResult result_;
  Histogram step_times_;
  std::size_t rows_ = 0;           ///< in the table
  std::optional<RowBlock> block_;  ///< of output rows
  std::optional<StateSampler> states_;
  long states_every_ = 1;  ///< interval of states in rows
  std::vector<Column> state_columns_;
  RowBlock::Sink state_sink_;
  std::optional<RowBlock> state_block_;  ///< of output states
  double* state_row_ = nullptr;          ///< its row without health columns yet
  std::optional<JointFollower> joints_;
  std::optional<RunWatch> watch_;
  std::optional<StepControl> control_;
};

}  // namespace floatframe
