#include "floatframe/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/run/run_loop.hpp"

namespace floatframe {

void check_step(const SimulationDescription& o) {
  if (o.duration > 0.0 && !(o.step <= o.duration * (1.0 + 1e-9)))
    throw InputError(
        ErrorCode::out_of_range, mark_of_time_settings(o),
        fmt::format(
            "the step of {:g} s is longer than the duration of {:g} s: expected at least one step",
            o.step, o.duration));
}

long steps_per_row(const SimulationDescription& o) noexcept {
  return o.output_interval > 0.0 ? std::max(1L, std::lround(o.output_interval / o.step)) : 1;
}

RunSummary asked_summary(const std::string& model, const SimulationDescription& o) {
  RunSummary s;
  s.model = model;
  s.coordinates = rules::coordinates[index_of(o.coordinates)];
  s.inertia = rules::inertia_methods[index_of(o.inertia)];
  s.step = o.step;
  s.locates_edges = o.locate_edges;
  if (o.until) s.until = o.until->text;
  return s;
}

std::string until_text(const RunSummary& s) {
  if (s.until.empty() || s.status != "completed") return {};
  if (!s.crossed_at) return "ended with its duration: " + s.until + " did not cross zero";
  return fmt::format("ended at t = {:.10g} s, where {} crosses zero", *s.crossed_at, s.until);
}

RunSummary failed_summary(const std::string& model, const SimulationDescription& o,
                          const std::string& message) {
  RunSummary s = asked_summary(model, o);
  s.status = "failed";
  s.message = message;
  return s;
}

namespace {

void require_run(const Model& given, const SimulationDescription& o) {
  require_valid_run(o);
  check_step(o);
  const SharedFormula& built_with = given.simulation.until;
  if (o.until && (!given.until || !built_with || o.until->text != built_with->text))
    throw InputError(ErrorCode::contradiction, o.origin.of("until"),
                     "simulation.until: found a formula that the model was not built with");
}

}  // namespace

RunResult run(const Model& given, const SimulationDescription& o, const RunOptions& run_options) {
  require_run(given, o);
  return Run(given, o, run_options).result();
}

RunResult run(const Model& given, const SimulationDescription& o, const RunOptions& run_options,
              const Controller& controller) {
  require_run(given, o);
  if (run_options.checkpoint || run_options.resume)
    throw InputError(ErrorCode::contradiction,
                     "on_step: found a run with checkpoints, which do not hold what a program "
                     "remembers, expected one without");
  return Run(given, o, run_options, &controller).result();
}

}  // namespace floatframe
