// floatframe bench chain: options, and exit code 1 if a run of the table failed.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/bench/bench_chain.hpp"
#include "floatframe/bench/bench_command.hpp"
#include "floatframe/bench/chain_model.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

struct ChainArguments {
  ChainOptions options;
  std::string step, duration, tolerance, spectral_radius, seconds, json_file;
  bool overwrite = false;
  std::string coordinates, inertia;
};

ChainOptions checked(const ChainArguments& a) {
  ChainOptions o = a.options;
  if (!a.step.empty()) o.step = positive_number("--step", a.step);
  if (!a.duration.empty()) o.duration = positive_number("--duration", a.duration);
  if (!a.seconds.empty()) o.seconds = positive_number("--seconds", a.seconds);
  if (!a.tolerance.empty()) o.tolerance = number_within("--tolerance", a.tolerance, 0.0, 1.0);
  if (!a.spectral_radius.empty())
    o.spectral_radius = number_within("--spectral-radius", a.spectral_radius, 0.0, 1.0);
  if (!a.coordinates.empty()) o.coordinates = {coordinates_from(a.coordinates)};
  if (!a.inertia.empty()) o.inertia = {inertia_from(a.inertia)};
  if (o.duration < o.step)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("--duration: found {:g} s, expected at least one step of {:g} s",
                                 o.duration, o.step));
  if (o.duration / o.step > 1e7)
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("--step: found {:g} s, expected at most 10 million steps in {:g} s", o.step,
                    o.duration));
  const int most = largest_chain_modes(o.elements);
  for (const int modes : o.modes) {
    if (modes > most)
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("--modes: found {}, expected at most {} with {} per link", modes,
                                   most, plural(o.elements, "element")));
  }
  return o;
}

int run_chain(const ChainArguments& arguments) {
  ChainOptions options = checked(arguments);
  require_writable({{"--json", arguments.json_file}}, {}, arguments.overwrite);
  ProgressBar bar(true, 100.0, "%");
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  const ChainResult result = bench_chain(options);
  bar.clear();
  if (!arguments.json_file.empty()) write_file(arguments.json_file, chain_json(result));
  print(chain_text(result));
  const bool failed = std::any_of(result.rows.begin(), result.rows.end(),
                                  [](const ChainRow& row) { return !row.failure.empty(); });
  return failed ? 1 : 0;
}

}  // namespace

Command bench_chain_command() {
  const auto a = std::make_shared<ChainArguments>();
  return {
      .name = "chain",
      .help = "Chains of flexible links: time per step, iterations, accuracy, energy",
      .options =
          {whole_list("--links", a->options.links, 1, 4096,
                      "Numbers of links, comma-separated (default 1,4,16,64,256)"),
           whole_list("--modes", a->options.modes, 1, 1000,
                      "Modes per link, comma-separated (default 8: six static, two normal)"),
           whole_option("--elements", a->options.elements, 1, 100000,
                        "Elements per link (default 20)"),
           text_option("--step", a->step, "SECONDS", "Time step [s] (default 0.001)"),
           text_option("--duration", a->duration, "SECONDS", "Time to simulate [s] (default 2)"),
           coordinates_option(a->coordinates, "Only these coordinates: relative or absolute"),
           inertia_option(a->inertia, "Only this method: preprocessing or projection"),
           text_option("--tolerance", a->tolerance, "NUMBER",
                       "Newton tolerance: largest coordinate increment (default 1e-9)"),
           text_option("--spectral-radius", a->spectral_radius, "NUMBER",
                       "Spectral radius at infinite frequency (default 0.9; 1: trapezoidal rule)"),
           whole_option("--repeat", a->options.runs, 1, 1000,
                        "Least number of timed runs of a row (default 5)"),
           text_option("--seconds", a->seconds, "SECONDS",
                       "Approximate processor time for the timed runs of a row (default 2)"),
           text_option("--json", a->json_file, "FILE", "Write the figures to this file as JSON"),
           overwrite_option(a->overwrite)},
      .footer =
          "Links are steel beams of 1 m hung by parallel hinges and released from the horizontal.\n"
          "Times are processor times of stepping, without input and output.",
      .run = [a] { return run_chain(*a); }};
}

}  // namespace floatframe
