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

template <class F>
RunResult run_with(const Model& given, const SimulationDescription& o,
                   const RunOptions& run_options) {
  StartedModel<F> start(given, o);
  F& f = start.formulation();
  const Model& model = start.model();
  RunResult result;
  RunSummary& s = result.summary;
  s = summary_of(model.name, o);
  s.start = start.report();

  Runner<F> runner(f, start.step_options(), start.min_step());
  runner.state() = start.state();
  s.energy.kinetic_start = runner.kinetic_energy();
  s.energy.potential_start = runner.potential_energy();
  s.energy.elastic_start = runner.elastic_energy();
  s.energy.total_start = s.energy.kinetic_start + s.energy.potential_start + s.energy.elastic_start;

  ResultTable& table = result.table;
  table.columns.push_back({"time", "s"});
  for (const Output& out : model.outputs) table.columns.push_back({out.name, out.unit});
  const std::size_t width = table.columns.size();
  const long steps = std::max(0L, std::lround(std::ceil(o.duration / o.step - 1e-9)));
  const long every =
      o.output_interval > 0.0 ? std::max(1L, std::lround(o.output_interval / o.step)) : 1;
  std::size_t rows = 0;
  if (run_options.record) {
    table.data.assign((static_cast<std::size_t>(steps / every) + 3) * width, 0.0);
    runner.sample(table.data.data());
    rows = 1;
  }
  const double begin = runner.state().t;
  std::optional<JointFollower> joints;
  if (run_options.keep_state) {
    joints.emplace(model);
    system_state(f, runner.state(), *joints);
  }
  std::optional<RunWatch<F>> watch;
  if (run_options.record && run_options.watch) {
    watch.emplace(f, o.step, steps / every);
    watch->start(runner.state());
  }
  const long report_every = std::max(1L, steps / 100);
  for (long k = 0; k < steps; ++k) {
    const double from = begin + static_cast<double>(k) * o.step;
    const double to = std::min(begin + static_cast<double>(k + 1) * o.step, begin + o.duration);
    const double before = cpu_seconds();
    // Exactly the step, not a difference of times that varies in its last bits.
    const bool part = to - from < (1.0 - 1e-9) * o.step;
    const bool good = runner.advance(part ? to - from : o.step);
    const bool sampled = good && run_options.record && ((k + 1) % every == 0 || k + 1 == steps);
    if (good) {
      runner.state().t = to;
      ++s.steps;
      if (sampled) runner.sample(table.data.data() + width * rows++);
    }
    s.cpu += cpu_seconds() - before;
    if (good && joints) joints->follow(f, runner.state());
    if (good && watch) watch->step(runner.state(), runner.reactions(), sampled, !part);
    if (!good) {
      s.status = "failed";
      s.message = runner.failure();
      s.message += light_motion_note(f, runner.state());  // moves f
      break;
    }
    if (run_options.progress && (k + 1) % report_every == 0)
      run_options.progress(static_cast<double>(k + 1) / static_cast<double>(steps));
  }
  table.data.resize(rows * width);
  s.duration = runner.state().t - begin;
  s.substeps = runner.substeps();
  s.iterations = runner.iterations();
  s.factorizations = runner.factorizations();
  s.real_time_factor = s.cpu > 0.0 ? s.duration / s.cpu : 0.0;
  s.max_position_violation = runner.max_position_violation();
  s.max_velocity_violation = runner.max_velocity_violation();
  s.energy.potential_end = runner.potential_energy();
  s.energy.elastic_end = runner.elastic_energy();
  s.energy.kinetic_end = runner.kinetic_energy();
  s.energy.total_end = s.energy.kinetic_end + s.energy.potential_end + s.energy.elastic_end;
  if (joints) {
    result.state = std::make_shared<SystemState>(system_state(f, runner.state(), *joints));
    place_bodies(model, o.inertia, *result.state);
  }
  if (watch) {
    watch->finish(runner.state(), o.spectral_radius, s);
    const auto unresolved = unresolved_forcing(model, o.step, begin, o.duration);
    s.warnings.insert(s.warnings.begin(), unresolved.begin(), unresolved.end());
  }
  return result;
}

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
             ? run_with<RelativeFormulation>(given, o, run_options)
             : run_with<AbsoluteFormulation>(given, o, run_options);
}

}  // namespace floatframe
