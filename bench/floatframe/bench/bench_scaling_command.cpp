// floatframe bench scaling: options, and exit code 1 if a run of the tables failed.
#include <algorithm>

#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/bench/bench_command.hpp"
#include "floatframe/bench/bench_scaling.hpp"
#include "floatframe/core/atomic_file.hpp"

namespace floatframe {
namespace {

struct ScalingArguments {
  ScalingOptions options;
  std::vector<std::string> sweeps;
  bool overwrite = false;
  std::string step, seconds, coordinates, inertia, json_file;
};

int run_scaling(const ScalingArguments& a) {
  ScalingOptions options = a.options;
  if (!a.step.empty()) options.step = positive_number("--step", a.step);
  if (!a.seconds.empty()) options.seconds = positive_number("--seconds", a.seconds);
  if (!a.coordinates.empty()) options.coordinates = {coordinates_from(a.coordinates)};
  if (!a.inertia.empty()) options.inertia = {inertia_from(a.inertia)};
  if (!a.sweeps.empty()) {
    options.sweeps.clear();
    for (const Sweep sweep : all_sweeps) {
      if (std::find(a.sweeps.begin(), a.sweeps.end(), word(sweep)) != a.sweeps.end())
        options.sweeps.push_back(sweep);
    }
  }
  require_writable({{"--json", a.json_file}}, {}, a.overwrite);
  ProgressBar bar(true, 100.0, "%");
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  const ScalingResult result = bench_scaling(options);
  bar.clear();
  if (!a.json_file.empty()) write_file(a.json_file, scaling_json(result));
  print(scaling_text(result));
  const bool failed = std::any_of(result.rows.begin(), result.rows.end(),
                                  [](const ScalingRow& row) { return !row.failure.empty(); });
  return failed ? 1 : 0;
}

}  // namespace

Command bench_scaling_command() {
  const auto a = std::make_shared<ScalingArguments>();
  std::vector<std::string> sweeps;
  for (const Sweep sweep : all_sweeps) sweeps.emplace_back(word(sweep));
  return {
      .name = "scaling",
      .help = "Cost of a step against elements, interface nodes, modes and bodies",
      .options =
          {word_list("--sweep", a->sweeps, sweeps,
                     "Only these: elements, interface-nodes, modes, bodies; comma-separated"),
           text_option("--step", a->step, "SECONDS", "Time step [s] (default 0.001)"),
           whole_option("--steps", a->options.steps, 1, 1000000, "Steps of a run (default 100)"),
           coordinates_option(a->coordinates, "Only these coordinates: relative or absolute"),
           inertia_option(a->inertia, "preprocessing (default) or projection"),
           whole_option("--repeat", a->options.runs, 1, 1000,
                        "Least number of timed runs of a row (default 5)"),
           text_option("--seconds", a->seconds, "SECONDS",
                       "Approximate processor time for the timed runs of a row (default 0.5)"),
           text_option("--json", a->json_file, "FILE", "Write the figures to this file as JSON"),
           overwrite_option(a->overwrite)},
      .footer = "Times are processor times of stepping, without input and output.",
      .run = [a] { return run_scaling(*a); }};
}

}  // namespace floatframe
