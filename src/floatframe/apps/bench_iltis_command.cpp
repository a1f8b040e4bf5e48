// floatframe bench iltis: finds the Iltis model, measures, prints and optionally writes JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "floatframe/apps/bench_command.hpp"
#include "floatframe/apps/bench_iltis.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/core/atomic_file.hpp"

namespace floatframe {
namespace {

struct BenchArguments {
  BenchOptions options;
  std::string step, duration, json_file;
};

int run_bench(const BenchArguments& arguments) {
  BenchOptions options = arguments.options;
  const std::string& json_file = arguments.json_file;
  if (!arguments.step.empty()) options.step = positive_number("--step", arguments.step);
  if (!arguments.duration.empty()) {
    options.duration = positive_number("--duration", arguments.duration);
  }
  if (options.model.empty()) options.model = find_iltis();
  require_writable({{"--json", json_file}});
  ProgressBar bar(true, 100.0, "%");
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  const BenchResult result = bench_iltis(options);
  bar.clear();
  if (!json_file.empty()) write_file(json_file, bench_json(result));
  print(bench_text(result));
  return 0;
}

}  // namespace

void add_bench_iltis(CLI::App& bench, Action& action) {
  CLI::App* iltis = bench.add_subcommand(
      "iltis", "The Iltis manoeuvre: Table 1 of the paper beside this machine");
  auto arguments = std::make_shared<BenchArguments>();
  iltis->add_option("--json", arguments->json_file, "Write the figures to this file as JSON")
      ->type_name("FILE");
  iltis->add_option("--repeat", arguments->options.repeats, "Runs of each combination (default 5)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  iltis
      ->add_option("--elements", arguments->options.elements,
                   "Elements a bar, comma-separated (default 5,10,50,100)")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000))
      ->type_name("LIST");
  iltis
      ->add_option("--model", arguments->options.model,
                   "Model file with a parameter ne (default: the example iltis.yaml)")
      ->type_name("FILE");
  iltis->add_option("--step", arguments->step, "Time step [s]; default: that of the model file")
      ->type_name("SECONDS");
  iltis
      ->add_option("--duration", arguments->duration,
                   "Time to simulate [s]; default: that of the model file")
      ->type_name("SECONDS");
  iltis->footer("Times are processor seconds of stepping, without input and output.");
  iltis->callback([arguments, &action] { action = [arguments] { return run_bench(*arguments); }; });
}

}  // namespace floatframe
