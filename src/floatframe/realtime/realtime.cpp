#include "floatframe/realtime/realtime.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/sampling.hpp"
#include "floatframe/realtime/denormals.hpp"
#include "floatframe/realtime/realtime_runner.hpp"
#include "floatframe/realtime/scheduling.hpp"
#include "floatframe/run/forcing.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {
namespace {

/// A step may be divided into few parts only, or not at all, to bound its work.
StepLimits limits(const SimulationDescription& d, const RealTimeOptions& options) {
  constexpr double smallest_part = 0.125;
  StepLimits l;
  l.duration = options.endless ? TimeGrid::endless : d.duration;
  l.min_step = options.fixed_iterations > 0 ? d.step : smallest_part * d.step;
  l.fixed_iterations = options.fixed_iterations;
  l.time_budget = options.time_budget;
  l.bounded = true;
  return l;
}

/// A few steps of a second system of the same kind, so that program pages are mapped, library calls
/// are resolved, and caches and branch predictors are warm. The run itself is not affected.
void warm_up(const Stepper& model) {
  Stepper second(model, 20.0 * model.grid().step());
  RealTimeReport report;
  RealTimeOptions options;
  options.paced = false;
  RealTimeRunner runner(second, options, nullptr, report);
  runner.run();
  runner.sample();
  // Inputs that jump require more work: also one step with different inputs.
  const std::span<const double> inputs = second.formulation().inputs();
  std::vector<double> moved(inputs.begin(), inputs.end());
  if (moved.empty()) return;
  for (double& x : moved) x += 1e-3 * (1.0 + std::abs(x));
  second.restart();  // its grid has ended
  second.formulation().set_inputs(moved);
  second.advance();
}

void run_with(const Model& given, const SimulationDescription& d, const RealTimeOptions& options,
              SignalPort* port, RealTimeReport& report) {
  Stepper steps(given, d, limits(d, options));
  require_ticks_at_steps(steps.model(), steps.begin(), d.step);
  report.start = steps.start_report();
  RealTimeRunner runner(steps, options, port, report);
  MotionWatch watch(steps.model(), d.step);
  if (options.watch) runner.watched_by(watch);
  const RealTimeScheduling scheduling({options.priority, options.lock_memory});
  report.priority = scheduling.has_priority();
  report.memory_locked = scheduling.memory_locked();
  report.refusals = scheduling.refusals();
  if (options.strict && !report.refusals.empty())
    throw RunError(ErrorCode::unavailable, report.refusals.front());
  using End = RealTimeRunner::End;
  End end = End::completed;
  {
    const FlushDenormals flush;
    if (options.paced) warm_up(steps);
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
      report.message = steps.failure();
      break;
    case End::no_inputs:
      report.status = "failed";
      report.message =
          fmt::format("no inputs arrived in reply to the outputs at t = {:.9g} s", report.time);
      break;
    case End::silent:
      report.status = "failed";
      report.message = fmt::format("no inputs arrived for {:g} s after t = {:.9g} s",
                                   options.input_timeout, report.last_inputs);
      break;
  }
  if (options.watch) {
    report.warnings =
        unresolved_forcing(steps.model(), d.step, steps.begin(), report.time - steps.begin());
    const auto left = watch.range().warnings(EnergySummary(), d.spectral_radius, {});
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
  run_with(model, d, options, port, report);
  return report;
}

}  // namespace floatframe
