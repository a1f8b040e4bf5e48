// floatframe bench start: options, and exit code 1 if a start failed.
#include <algorithm>

#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/bench/bench_command.hpp"
#include "floatframe/bench/bench_start.hpp"
#include "floatframe/core/atomic_file.hpp"

namespace floatframe {
namespace {

struct StartArguments {
  StartOptions options;
  std::vector<std::string> kinds;
  bool overwrite = false;
  std::string coordinates, json_file;
};

int run_starts(const StartArguments& a) {
  StartOptions options = a.options;
  if (!a.coordinates.empty()) options.coordinates = {coordinates_from(a.coordinates)};
  if (!a.kinds.empty())
    std::erase_if(options.kinds, [&](StartKind kind) {
      return std::find(a.kinds.begin(), a.kinds.end(), word(kind)) == a.kinds.end();
    });
  require_writable({{"--json", a.json_file}}, {}, a.overwrite);
  ProgressBar bar(true, 100.0, "%");
  options.progress = [&bar](double percent) { bar.show(percent); };
  const StartResult result = bench_start(options);
  bar.clear();
  if (!a.json_file.empty()) write_file(a.json_file, start_json(result));
  print(start_text(result));
  const bool failed = std::any_of(result.rows.begin(), result.rows.end(),
                                  [](const StartRow& row) { return !row.failure.empty(); });
  return failed ? 1 : 0;
}

}  // namespace

Command bench_start_command() {
  const auto a = std::make_shared<StartArguments>();
  std::vector<std::string> kinds;
  for (const StartKind kind : all_start_kinds) kinds.emplace_back(word(kind));
  return {.name = "start",
          .help = "Time from the built model to the first step",
          .options = {word_list("--model", a->kinds, kinds,
                                "Only these: chain, ladder, vehicles; comma-separated"),
                      coordinates_option(a->coordinates,
                                         "Only these coordinates: relative or absolute"),
                      whole_option("--from", a->options.least, 10, 100000,
                                   "Least number of coordinates, about (default 100)"),
                      whole_option("--to", a->options.most, 10, 100000,
                                   "Largest number of coordinates, about (default 5000)"),
                      whole_option("--repeat", a->options.runs, 1, 1000,
                                   "Timed starts of a row, at most (default 3)"),
                      text_option("--json", a->json_file, "FILE",
                                  "Write the figures to this file as JSON"),
                      overwrite_option(a->overwrite)},
          .footer = "Times are processor times, the least of the repetitions.",
          .run = [a] { return run_starts(*a); }};
}

}  // namespace floatframe
