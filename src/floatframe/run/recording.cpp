#include "floatframe/run/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/run/forcing.hpp"
#include "floatframe/run/row_store.hpp"
#include "floatframe/run/run_watch.hpp"
#include "floatframe/run/state_layout.hpp"
#include "floatframe/run/step_times.hpp"
#include "floatframe/run/summary_ends.hpp"
#include "floatframe/stepping/step_observer.hpp"

namespace floatframe {

class Recording::Observer final : public StepObserver {
 public:
  Observer(Simulation& simulation, const RecordingOptions& options)
      : simulation_(&simulation), options_(options) {
    simulation.observe(this);
  }
  ~Observer() override {
    if (simulation_) simulation_->observe(nullptr);
  }
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  void begin(Stepper& steps, std::span<const double> row, StepsBegin why) override {
    steps_ = &steps;
    failed_ = false;
    if (why == StepsBegin::again)
      go_on_from(row);
    else
      begin_here(row);
    steps.set_edge_watch({&*watch_, [](void* watch, const State& state, const VecX& r) noexcept {
                            static_cast<RunWatch*>(watch)->edge(state, r);
                          }});
  }

  void step(Stepper& steps, std::span<const double> row, const PlannedStep& planned,
            Nanoseconds taken) noexcept override {
    ++made_;
    watch_->step(steps.state(), steps.reactions(), true, planned.whole);
    watch_->attempt(steps.state(), steps.last());
    if (!options_.rows) return;
    cpu_ += 1e-9 * static_cast<double>(taken);
    step_times_.add(taken);
    if (made_ % options_.every == 0) keep(row);
  }

  void failed(Stepper&) noexcept override { failed_ = true; }
  void end() noexcept override {
    simulation_ = nullptr;
    steps_ = nullptr;
  }
  bool timed() const noexcept override { return options_.rows; }

  std::size_t instants() const noexcept { return rows_ ? rows_->size() : 0; }
  std::vector<RangeWarning> warnings() {
    RunSummary s;
    finish_watch(s);
    return std::move(s.warnings);
  }
  RunResult result();
  SimulationDescription options() const;
  const StateLayout& layout() const { return sampler_->layout(); }
  std::vector<double> states() const { return states_->numbers(); }

  Simulation& simulation() const {
    if (!simulation_)
      throw InputError(ErrorCode::missing, "found a recording whose simulation has ended");
    return *simulation_;
  }

 private:
  /// Instants for which the energies are evaluated: each costs up to 8 % of a step of a vehicle.
  static constexpr long checked = 20, checks = 50;

  void begin_here(std::span<const double> row);
  void go_on_from(std::span<const double> row);
  void keep(std::span<const double> row) noexcept;
  void finish_watch(RunSummary& s);
  void remember_balance();

  Simulation* simulation_;
  RecordingOptions options_;
  Stepper* steps_ = nullptr;
  std::optional<RunWatch> watch_;
  std::optional<StateSampler> sampler_;
  std::optional<RowStore> rows_, states_;
  std::vector<double> scratch_;       ///< a row of states
  std::vector<RangeWarning> before_;  ///< of balances that ended with a restored state
  RunSummary start_;
  Histogram step_times_;
  double begin_ = 0.0, cpu_ = 0.0;  ///< [s]
  long made_ = 0;                   ///< steps
  bool failed_ = false, lost_ = false;
};

void Recording::Observer::begin_here(std::span<const double> row) {
  made_ = 0;
  cpu_ = 0.0;
  step_times_ = {};
  before_.clear();
  begin_ = row[0];
  watch_.emplace(steps_->formulation(), steps_->grid().step(), checked * checks);
  start_ = summary_at_start(*steps_, simulation_->options());
  watch_->start(steps_->state());
  if (!options_.rows) return;
  sampler_.emplace(steps_->formulation(), RecordDescription{}, watch_->health_columns());
  rows_.emplace(row.size(), options_.keep);
  states_.emplace(static_cast<std::size_t>(layout().columns), options_.keep);
  scratch_.resize(static_cast<std::size_t>(layout().columns));
  keep(row);
}

void Recording::Observer::go_on_from(std::span<const double> row) {
  remember_balance();
  watch_->start_again(steps_->state());
  made_ = 0;
  if (!options_.rows) {
    begin_ = row[0];
    return;
  }
  watch_->health(steps_->counters(), scratch_.data() + layout().groups.back().first);
  for (RowStore* store : {&*rows_, &*states_}) store->drop_after(row[0]);
  if (rows_->size() > 0 && rows_->last_time() == row[0]) return;
  if (rows_->size() == 0) begin_ = row[0];
  keep(row);
}

void Recording::Observer::keep(std::span<const double> row) noexcept {
  double *const outputs = rows_->next(), *const state = states_->next();
  lost_ = lost_ || !outputs || !state;
  if (lost_) return;
  std::copy(row.begin(), row.end(), outputs);
  sampler_->sample(steps_->state(), state);
  watch_->health(steps_->counters(), state + layout().groups.back().first);
}

/// A balance that did not close is not forgotten with the next one. The stepper is elsewhere by
/// now: up to the last check.
void Recording::Observer::remember_balance() {
  const EnergySummary e = watch_->balance();
  if (!(std::abs(e.largest_remainder) > watch_->limits().imbalance * e.exchanged)) return;
  before_ = watch_->range_warnings(steps_->step_options().spectral_radius, steps_->corners());
}

void Recording::Observer::finish_watch(RunSummary& s) {
  if (failed_ && s.message.empty()) s.message = simulation().failure();  // while it can be found
  watch_->finish(steps_->state(), steps_->step_options().spectral_radius, steps_->corners(), s);
  const double duration = steps_->state().t - begin_;
  const auto unresolved = unresolved_forcing(steps_->model(), steps_->grid().step(), begin_,
                                             std::max(0.0, duration), steps_->corners());
  s.warnings.insert(s.warnings.begin(), unresolved.begin(), unresolved.end());
  warn_of_steps(*steps_, s.warnings);
  for (const RangeWarning& w : before_)
    if (std::ranges::none_of(s.warnings, [&](const auto& x) { return x.limit == w.limit; }))
      s.warnings.push_back(w);
}

RunResult Recording::Observer::result() {
  RunResult out;
  const Simulation& simulation = this->simulation();
  out.table.columns.push_back({"time", "s"});
  for (const Output& output : simulation.model().outputs)
    out.table.columns.push_back({output.name, output.unit});
  if (rows_) out.table.data = rows_->numbers();
  RunSummary& s = out.summary;
  s = start_;
  s.cpu = cpu_;
  if (failed_) {
    s.status = "failed";
    s.message = simulation.failure();
    out.thrown = simulation.thrown();
  }
  out.state = std::make_shared<SystemState>(simulation.state());
  s.step_times = step_times(step_times_);
  write_end(*steps_, begin_, s);
  finish_watch(s);
  if (lost_) s.start.notes.push_back("memory ran out: the recording ends before the simulation");
  return out;
}

SimulationDescription Recording::Observer::options() const {
  SimulationDescription o = simulation().options();
  const double step = o.step;
  o.duration = std::max(0.0, simulation_->time() - begin_);
  o.output_interval = step * static_cast<double>(options_.every);
  o.until = nullptr;
  o.record.states = RecordDescription::States::states;
  o.record.every = 1;
  return o;
}

Recording::Recording(Simulation& simulation, const RecordingOptions& options) {
  if (options.every < 1)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("every: found {}, expected at least 1 step", options.every));
  observer_ = std::make_unique<Observer>(simulation, options);
}
Recording::~Recording() = default;

std::size_t Recording::instants() const noexcept { return observer_->instants(); }
std::vector<RangeWarning> Recording::warnings() {
  observer_->simulation();
  return observer_->warnings();
}
RunResult Recording::result() { return observer_->result(); }
SimulationDescription Recording::options() const { return observer_->options(); }
const StateLayout& Recording::layout() const { return observer_->layout(); }
std::vector<double> Recording::states() const { return observer_->states(); }

}  // namespace floatframe
