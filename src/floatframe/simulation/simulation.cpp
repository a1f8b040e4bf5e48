#include "floatframe/simulation/simulation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <optional>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/simulation/forcing.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/light_motion.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/run_watch.hpp"
#include "floatframe/simulation/runner.hpp"
#include "floatframe/simulation/start_up.hpp"
#include "floatframe/simulation/system_state.hpp"

namespace floatframe {

namespace {

double cpu_seconds() noexcept {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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
        start_(given, o),
        f_(start_.formulation()),
        runner_(f_, start_.step_options(), start_.min_step()),
        begin_(start_.state().t),
        steps_(std::max(0L, std::lround(std::ceil(o.duration / o.step - 1e-9)))),
        every_(o.output_interval > 0.0 ? std::max(1L, std::lround(o.output_interval / o.step))
                                       : 1) {
    RunSummary& s = result_.summary;
    s = summary_of(start_.model().name, o);
    s.start = start_.report();
    runner_.state() = start_.state();
    EnergySummary& e = s.energy;
    energies(e.kinetic_start, e.potential_start, e.elastic_start, e.total_start);
    begin_table();
    if (options.keep_state) {
      joints_.emplace(start_.model());
      system_state(f_, runner_.state(), *joints_);
    }
    if (options.record && options.watch) {
      watch_.emplace(f_, o.step, steps_ / every_);
      watch_->start(runner_.state());
    }
  }

  RunResult result() {
    const long report_every = std::max(1L, steps_ / 100);
    for (long k = 0; k < steps_ && step(k); ++k)
      if (options_.progress && (k + 1) % report_every == 0)
        options_.progress(static_cast<double>(k + 1) / static_cast<double>(steps_));
    finish();
    return std::move(result_);
  }

 private:
  void begin_table() {
    ResultTable& table = result_.table;
    table.columns.push_back({"time", "s"});
    for (const Output& out : start_.model().outputs) table.columns.push_back({out.name, out.unit});
    if (!options_.record) return;
    table.data.assign((static_cast<std::size_t>(steps_ / every_) + 3) * table.columns.size(), 0.0);
    sample();
  }

  void sample() noexcept {
    ResultTable& table = result_.table;
    runner_.sample(table.data.data() + table.columns.size() * rows_++);
  }

  /// False: it failed.
  bool step(long k) {
    RunSummary& s = result_.summary;
    const double from = begin_ + static_cast<double>(k) * o_.step;
    const double to = std::min(begin_ + static_cast<double>(k + 1) * o_.step, begin_ + o_.duration);
    const double before = cpu_seconds();
    // Exactly the step, not a difference of times that varies in its last bits.
    const bool part = to - from < (1.0 - 1e-9) * o_.step;
    const bool good = runner_.advance(part ? to - from : o_.step);
    const bool sampled = good && options_.record && ((k + 1) % every_ == 0 || k + 1 == steps_);
    if (good) {
      runner_.state().t = to;
      ++s.steps;
      if (sampled) sample();
    }
    s.cpu += cpu_seconds() - before;
    if (good && joints_) joints_->follow(f_, runner_.state());
    if (good && watch_) watch_->step(runner_.state(), runner_.reactions(), sampled, !part);
    if (good) return true;
    s.status = "failed";
    s.message = runner_.failure();
    s.message += light_motion_note(f_, runner_.state());  // moves f_
    return false;
  }

  void finish() {
    RunSummary& s = result_.summary;
    result_.table.data.resize(rows_ * result_.table.columns.size());
    s.duration = runner_.state().t - begin_;
    s.substeps = runner_.substeps();
    s.iterations = runner_.iterations();
    s.factorizations = runner_.factorizations();
    s.real_time_factor = s.cpu > 0.0 ? s.duration / s.cpu : 0.0;
    s.max_position_violation = runner_.max_position_violation();
    s.max_velocity_violation = runner_.max_velocity_violation();
    EnergySummary& e = s.energy;
    energies(e.kinetic_end, e.potential_end, e.elastic_end, e.total_end);
    if (joints_) {
      result_.state = std::make_shared<SystemState>(system_state(f_, runner_.state(), *joints_));
      place_bodies(start_.model(), o_.inertia, *result_.state);
    }
    if (!watch_) return;
    watch_->finish(runner_.state(), o_.spectral_radius, s);
    const auto unresolved = unresolved_forcing(start_.model(), o_.step, begin_, o_.duration);
    s.warnings.insert(s.warnings.begin(), unresolved.begin(), unresolved.end());
  }

  /// At the present state, to which the formulation is brought.
  void energies(double& kinetic, double& potential, double& elastic, double& total) noexcept {
    potential = runner_.potential_energy();  // brings it there
    elastic = runner_.elastic_energy();
    kinetic = runner_.kinetic_energy();
    total = kinetic + potential + elastic;
  }

  const SimulationDescription& o_;
  const RunOptions& options_;
  StartedModel<F> start_;
  F& f_;
  Runner<F> runner_;
  const double begin_;
  const long steps_, every_;  ///< every so many steps are sampled
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
