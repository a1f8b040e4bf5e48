// floatframe bench iltis: finds the Iltis model, measures, prints and optionally writes JSON.
#include <fmt/format.h>

#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/bench/bench_command.hpp"
#include "floatframe/bench/bench_iltis.hpp"
#include "floatframe/core/atomic_file.hpp"

namespace floatframe {
namespace {

struct BenchArguments {
  BenchOptions options;
  std::string step, duration, json_file;
  bool overwrite = false;
};

int run_bench(const BenchArguments& arguments) {
  BenchOptions options = arguments.options;
  const std::string& json_file = arguments.json_file;
  if (!arguments.step.empty()) options.step = positive_number("--step", arguments.step);
  if (!arguments.duration.empty()) {
    options.duration = positive_number("--duration", arguments.duration);
  }
  if (options.model.empty()) options.model = find_iltis();
  require_writable({{"--json", json_file}}, {}, arguments.overwrite);
  ProgressBar bar(true, 100.0, "%");
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  const BenchResult result = bench_iltis(options);
  bar.clear();
  if (!json_file.empty()) write_file(json_file, bench_json(result));
  print(bench_text(result));
  return 0;
}

}  // namespace

Command bench_iltis_command() {
  const auto a = std::make_shared<BenchArguments>();
  return {
      .name = "iltis",
      .help = "The Iltis manoeuvre: Table 1 of the paper and of this machine",
      .options = {text_option("--json", a->json_file, "FILE",
                              "Write the figures to this file as JSON"),
                  whole_option("--repeat", a->options.repeats, 1, 1000,
                               "Runs of each combination (default 5)"),
                  whole_list("--elements", a->options.elements, 1, 100000,
                             "Elements per bar, comma-separated (default 5,10,50,100)"),
                  text_option("--model", a->options.model, "FILE",
                              "Model file with a parameter ne (default: the example iltis.yaml)"),
                  text_option("--step", a->step, "SECONDS",
                              "Time step [s]; default: that of the model file"),
                  text_option("--duration", a->duration, "SECONDS",
                              "Time to simulate [s]; default: that of the model file"),
                  overwrite_option(a->overwrite)},
      .footer = "Times are processor seconds of stepping, without input and output.",
      .run = [a] { return run_bench(*a); }};
}

}  // namespace floatframe
