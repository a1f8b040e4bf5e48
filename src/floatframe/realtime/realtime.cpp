#include "floatframe/realtime/realtime.hpp"

#include <fmt/format.h>

#include "floatframe/realtime/denormals.hpp"
#include "floatframe/realtime/realtime_runner.hpp"
#include "floatframe/realtime/scheduling.hpp"
#include "floatframe/simulation/forcing.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/light_motion.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "floatframe/simulation/start_up.hpp"

namespace floatframe {
namespace {

StepOptions bounded(StepOptions s, const RealTimeOptions& options) {
  s.fixed_iterations = options.fixed_iterations;
  s.time_budget = options.time_budget;
  return s;
}

/// A few steps of a second system of the same kind: program pages are mapped, calls into libraries
/// are resolved, caches and branch predictors know the code. Nothing of it touches the run.
template <class F>
void warm_up(const Model& model, const SimulationDescription& d, const StepOptions& step_options,
             const State& start) {
  F f(model, d.inertia);
  RealTimeReport report;
  RealTimeOptions options;
  options.paced = false;
  RealTimeRunner<F> runner(f, step_options, options, d.step, 20.0 * d.step, nullptr, report);
  runner.state() = start;
  runner.run();
  runner.sample();
}

template <class F>
void run_with(const Model& given, const SimulationDescription& d, const RealTimeOptions& options,
              SignalPort* port, RealTimeReport& report) {
  StartedModel<F> started(given, d);
  F& f = started.formulation();
  const State& start = started.state();
  report.start = started.report();
  const StepOptions step_options = bounded(started.step_options(), options);
  RealTimeRunner<F> runner(f, step_options, options, d.step, d.duration, port, report);
  runner.state() = start;
  MotionWatch<F> watch(f, d.step);
  if (options.watch) runner.watched_by(watch);
  const RealTimeScheduling scheduling({options.priority, options.lock_memory});
  report.priority = scheduling.has_priority();
  report.memory_locked = scheduling.memory_locked();
  report.refusals = scheduling.refusals();
  if (options.strict && !report.refusals.empty()) throw RunError(report.refusals.front());
  using End = typename RealTimeRunner<F>::End;
  End end = End::completed;
  {
    const FlushDenormals flush;
    if (options.paced) warm_up<F>(f.model(), d, step_options, start);
    const double stolen_before = stolen_time();
    end = runner.run();
    report.stolen = stolen_time() - stolen_before;
  }
  switch (end) {
    case End::completed:
      break;
    case End::stopped:
      report.status = "stopped";
      break;
    case End::failed:
      report.status = "failed";
      report.message = runner.failure();
      report.message += light_motion_note(f, runner.state());  // moves f
      break;
    case End::no_inputs:
      report.status = "failed";
      report.message =
          fmt::format("no inputs came in answer to the outputs at t = {:.9g} s", runner.state().t);
      break;
    case End::silent:
      report.status = "failed";
      report.message = fmt::format("no inputs came for {:g} s after t = {:.9g} s",
                                   options.input_timeout, report.last_inputs);
      break;
  }
  if (options.watch) {
    report.warnings = unresolved_forcing(f.model(), d.step, start.t, report.time - start.t);
    const auto left = watch.range().warnings(EnergySummary(), d.spectral_radius);
    report.warnings.insert(report.warnings.end(), left.begin(), left.end());
  }
  const std::span<const double> row = runner.sample();
  report.outputs.assign(row.begin() + 1, row.end());
  const InputBuffer& inputs = runner.inputs();
  report.inputs.assign(inputs.values().begin(), inputs.values().end());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    report.refused_inputs.push_back(inputs.refused(i));
  for (std::size_t i = 0; i < inputs.size(); ++i)
    report.clamped_inputs.push_back(inputs.clamped(i));
}

}  // namespace

RealTimeReport run_real_time(const Model& model, const SimulationDescription& d,
                             const RealTimeOptions& options, SignalPort* port) {
  require_valid(options, d);
  RealTimeReport report;
  report.model = model.name;
  report.coordinates = d.coordinates == Coordinates::relative ? "relative" : "absolute";
  report.inertia = d.inertia == InertiaMethod::preprocessing ? "preprocessing" : "projection";
  report.step = d.step;
  report.paced = options.paced;
  if (d.coordinates == Coordinates::relative)
    run_with<RelativeFormulation>(model, d, options, port, report);
  else
    run_with<AbsoluteFormulation>(model, d, options, port, report);
  return report;
}

}  // namespace floatframe
