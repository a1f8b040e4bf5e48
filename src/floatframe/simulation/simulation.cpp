#include "floatframe/simulation/simulation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/simulation/forcing.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/run_watch.hpp"
#include "floatframe/simulation/stepped_model.hpp"

namespace floatframe {

namespace {

RunSummary summary_of(const std::string& model, const SimulationDescription& o) {
  RunSummary s;
  s.model = model;
  s.coordinates = rules::coordinates[index_of(o.coordinates)];
  s.inertia = rules::inertia_methods[index_of(o.inertia)];
  s.step = o.step;
  return s;
}

/// One run: its steps, what is recorded and watched of them, its summary.
template <class F>
class Run {
 public:
  Run(const Model& given, const SimulationDescription& o, const RunOptions& options)
      : o_(o),
        options_(options),
        steps_(given, o, {.duration = o.duration}),
        planned_(steps_.grid().steps()),
        every_(o.output_interval > 0.0 ? std::max(1L, std::lround(o.output_interval / o.step))
                                       : 1) {
    RunSummary& s = result_.summary;
    s = summary_of(steps_.model().name, o);
    s.start = steps_.start_report();
    const Energies e = steps_.energies();
    s.energy.kinetic_start = e.kinetic;
    s.energy.potential_start = e.potential;
    s.energy.elastic_start = e.elastic;
    s.energy.total_start = e.total();
    begin_table();
    if (options.keep_state) {
      joints_.emplace(steps_.model());
      joints_->follow(steps_.formulation(), steps_.state());
    }
    if (options.record && options.watch) {
      watch_.emplace(steps_.formulation(), o.step, planned_ / every_);
      watch_->start(steps_.state());
    }
  }

  RunResult result() {
    const long report_every = std::max(1L, planned_ / 100);
    for (long k = 1; k <= planned_ && step(k); ++k)
      if (options_.progress && k % report_every == 0)
        options_.progress(static_cast<double>(k) / static_cast<double>(planned_));
    finish();
    return std::move(result_);
  }

 private:
  void begin_table() {
    ResultTable& table = result_.table;
    table.columns.push_back({"time", "s"});
    for (const Output& out : steps_.model().outputs) table.columns.push_back({out.name, out.unit});
    if (!options_.record) return;
    table.data.assign((static_cast<std::size_t>(planned_ / every_) + 3) * table.columns.size(),
                      0.0);
    sample();
  }

  void sample() noexcept {
    ResultTable& table = result_.table;
    steps_.sample(table.data.data() + table.columns.size() * rows_++);
  }

  /// Step k, counted from 1. False: it failed.
  bool step(long k) {
    RunSummary& s = result_.summary;
    const Nanoseconds before = thread_cpu_clock();
    const PlannedStep planned = steps_.grid().next();
    const bool good = steps_.advance(planned);
    const bool sampled = good && options_.record && (k % every_ == 0 || k == planned_);
    if (sampled) sample();
    s.cpu += 1e-9 * static_cast<double>(thread_cpu_clock() - before);
    if (good && joints_) joints_->follow(steps_.formulation(), steps_.state());
    if (good && watch_) watch_->step(steps_.state(), steps_.reactions(), sampled, planned.whole);
    if (good) return true;
    s.status = "failed";
    s.message = steps_.failure();
    return false;
  }

  void finish() {
    RunSummary& s = result_.summary;
    result_.table.data.resize(rows_ * result_.table.columns.size());
    const StepCounters& c = steps_.counters();
    s.duration = steps_.state().t - steps_.begin();
    s.steps = c.steps;
    s.substeps = c.substeps;
    s.iterations = c.iterations;
    s.factorizations = c.factorizations;
    s.real_time_factor = s.cpu > 0.0 ? s.duration / s.cpu : 0.0;
    s.max_position_violation = c.max_position_violation;
    s.max_velocity_violation = c.max_velocity_violation;
    const Energies e = steps_.energies();
    s.energy.kinetic_end = e.kinetic;
    s.energy.potential_end = e.potential;
    s.energy.elastic_end = e.elastic;
    s.energy.total_end = e.total();
    if (joints_) result_.state = std::make_shared<SystemState>(steps_.system_state(*joints_));
    if (!watch_) return;
    watch_->finish(steps_.state(), o_.spectral_radius, s);
    const auto unresolved =
        unresolved_forcing(steps_.model(), o_.step, steps_.begin(), o_.duration);
    s.warnings.insert(s.warnings.begin(), unresolved.begin(), unresolved.end());
  }

  const SimulationDescription& o_;
  const RunOptions& options_;
  SteppedModel<F> steps_;
  const long planned_, every_;  ///< every so many of the planned steps are sampled
  RunResult result_;
  std::size_t rows_ = 0;
  std::optional<JointFollower> joints_;
  std::optional<RunWatch<F>> watch_;
};

}  // namespace

void check_step(const SimulationDescription& o) {
  if (o.duration > 0.0 && !(o.step <= o.duration * (1.0 + 1e-9)))
    throw InputError(
        place_of_clock(o),
        fmt::format(
            "the step of {:g} s is longer than the duration of {:g} s: expected at least one step",
            o.step, o.duration));
}

double default_penalty_mass(const Model& model) { return 1e5 * model.mean_mass; }

StepOptions step_options(const Model& model, const SimulationDescription& o) {
  StepOptions s;
  s.spectral_radius = o.spectral_radius;
  s.tolerance = o.tolerance;
  s.max_iterations = o.max_iterations;
  s.position_tolerance = o.position_tolerance;
  s.velocity_tolerance = o.velocity_tolerance;
  s.penalty_mass =
      o.penalty > 0.0 ? o.penalty * o.step * o.step / 4.0 : default_penalty_mass(model);
  return s;
}

State relative_start(RelativeFormulation& f, Start start, StartReport* report) {
  State state;
  f.start(state.q, state.v);
  VecX at_rest = VecX::Zero(f.velocities());
  close_loops(f, state.q, start == Start::equilibrium ? at_rest : state.v, true);
  if (start == Start::equilibrium) {
    find_equilibrium(f, state.q);
    close_loops(f, state.q, state.v, false);
  }
  if (report == nullptr) return state;
  f.positions(0.0, state.q);
  f.velocities(state.v);
  report_changes(f, state, start, *report);
  report_redundancy(f, state, *report);
  return state;
}

RunSummary failed_summary(const std::string& model, const SimulationDescription& o,
                          const std::string& message) {
  RunSummary s = summary_of(model, o);
  s.status = "failed";
  s.message = message;
  return s;
}

RunResult run(const Model& given, const SimulationDescription& o, const RunOptions& run_options) {
  require_valid_run(o);
  check_step(o);
  return o.coordinates == Coordinates::relative
             ? Run<RelativeFormulation>(given, o, run_options).result()
             : Run<AbsoluteFormulation>(given, o, run_options).result();
}

}  // namespace floatframe
