// floatframe validate: benchmarks in both formulations against their references.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <memory>
#include <thread>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/stop_signal.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/validation/benchmark_report.hpp"

namespace floatframe {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_benchmarks = "examples/benchmarks";

struct ValidateArguments {
  std::vector<std::string> of;
  std::string report;
  int threads = 0;
  bool json = false, quiet = false, overwrite = false;
};

bool is_benchmark(const fs::path& file) {
  const std::string name = file.filename().string();
  return name == "benchmark.yaml" || name.ends_with(".benchmark.yaml");
}

/// The benchmarks in a folder and in those below it, by name.
std::vector<std::string> benchmarks_in(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error))
    if (is_benchmark(it->path())) files.push_back(it->path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A folder, a file, or the name of a benchmark that comes with Floatframe.
std::vector<std::string> benchmark_files(const std::string& given) {
  std::error_code ignored;
  const fs::path own = fs::path(own_benchmarks) / given;
  const bool here = fs::exists(given, ignored);
  if (here && !fs::is_directory(given, ignored)) return {given};
  std::vector<std::string> files = benchmarks_in(here ? fs::path(given) : own);
  if (!files.empty()) return files;
  if (here)
    throw InputError(ErrorCode::not_found, {given, 0, 0},
                     "found no benchmark in this folder, expected a file benchmark.yaml or "
                     "NAME.benchmark.yaml in it or below");
  std::vector<std::string> names;
  for (const std::string& file : benchmarks_in(own_benchmarks))
    names.push_back(fs::path(file).parent_path().filename().string());
  throw InputError(ErrorCode::not_found,
                   fmt::format("found '{}', expected a folder, a benchmark.yaml or the name of a "
                               "folder in {}{}",
                               given, own_benchmarks, did_you_mean(given, names)));
}

/// Errors of settings name them as --set: here they stand in the file.
void add_errors(const InputError& error, const Benchmark& b, ErrorList& errors) {
  for (ErrorEntry e : error.errors()) {
    if (e.message.starts_with("--set")) {
      e.message = "set" + e.message.substr(5);
      e.mark = b.settings_mark;
    }
    errors.add(std::move(e));
  }
}

/// Reads everything before anything runs. `inputs` receives the files.
std::vector<ValidatedBenchmark> read_all(const ValidateArguments& a,
                                         std::vector<std::string>& inputs) {
  std::vector<ValidatedBenchmark> list;
  std::vector<std::string> files;
  const std::vector<std::string> all{own_benchmarks};
  for (const std::string& given : a.of.empty() ? all : a.of)
    for (std::string& file : benchmark_files(given))
      if (std::find(files.begin(), files.end(), file) == files.end())
        files.push_back(std::move(file));
  ErrorList errors;
  for (const std::string& file : files) {
    ValidatedBenchmark v;
    try {
      v.benchmark = read_benchmark(file);
      inputs.push_back(file);
      ModelFingerprint used;
      const ModelDescription d =
          read_model({.path = v.benchmark.model, .settings = v.benchmark.settings}, true, &used);
      check_inertia_method(d, d.simulation.inertia);
      for (const std::string& name : files_of(used)) inputs.push_back(name);
      v.model = std::make_shared<const Model>(build_model(d));
      require_outputs(v.benchmark, *v.model);
      list.push_back(std::move(v));
    } catch (const InputError& error) {
      add_errors(error, v.benchmark, errors);
    }
  }
  errors.throw_if_any();
  return list;
}

/// Each benchmark in each of its coordinates, `threads` at a time.
void run_all(std::vector<ValidatedBenchmark>& list, int threads, bool quiet) {
  struct Job {
    ValidatedBenchmark* of;
    std::size_t number;
  };
  std::vector<Job> jobs;
  for (ValidatedBenchmark& v : list) {
    v.results.resize(v.benchmark.coordinates.size());
    for (std::size_t k = 0; k < v.results.size(); ++k) jobs.push_back({&v, k});
  }
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<int> working{threads};
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size(); k = next++, ++done) {
      ValidatedBenchmark& v = *jobs[k].of;
      v.results[jobs[k].number] = run_benchmark(
          v.benchmark, *v.model, v.benchmark.coordinates[jobs[k].number], &StopSignal::flag());
    }
    --working;
  };
  std::vector<std::jthread> workers;
  for (int k = 0; k < threads; ++k) workers.emplace_back(work);
  ProgressBar bar(!quiet, 1.0, "");
  while (working.load() > 0) {
    bar.show(static_cast<double>(done.load()) / static_cast<double>(jobs.size()),
             fmt::format("{} of {}", done.load(), plural(static_cast<long>(jobs.size()), "run")));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

int validate_all(const ValidateArguments& a) {
  std::vector<std::string> inputs;
  std::vector<ValidatedBenchmark> list = read_all(a, inputs);
  require_writable({{"--report", a.report}}, inputs, a.overwrite);
  {
    const StopSignal signals(SA_RESTART);
    const auto all = static_cast<int>(std::thread::hardware_concurrency());
    run_all(list, std::max(1, a.threads > 0 ? a.threads : all), a.quiet);
    if (StopSignal::flag().load()) std::raise(StopSignal::number());
  }
  if (!a.report.empty()) write_file(a.report, validation_page(list, build_description()));
  print(a.json ? validation_json(list) : validation_text(list));
  const std::vector<std::string> failures = validation_failures(list);
  for (const std::string& sentence : failures) say(sentence);
  return failures.empty() ? exit_code::done : exit_code::failed;
}

}  // namespace

Command validate_command() {
  const auto a = std::make_shared<ValidateArguments>();
  return {
      .name = "validate",
      .help = "Run benchmarks in both formulations and compare them with their references",
      .options = {repeated_option(
                      "FOLDER", a->of, "...",
                      "Folders with benchmarks, files benchmark.yaml, or names of folders in "
                      "examples/benchmarks; default: all of these"),
                  whole_option("--threads", a->threads, 1, 4096,
                               "Runs at a time; default: number of processors"),
                  flag("--json", a->json, "JSON on standard output"),
                  text_option("--report", a->report, "FILE",
                              "Page with the table and a picture and a plot of each benchmark"),
                  flag("--quiet", a->quiet, "No progress bar"), overwrite_option(a->overwrite)},
      .footer =
          "A benchmark is a file benchmark.yaml beside a model file, with reference values and\n"
          "tolerances (docs/validation.md).\n"
          "Exit codes: 0 all within tolerance, 1 beyond it or a run failed, 2 bad input.",
      .run = [a] { return validate_all(*a); }};
}

}  // namespace floatframe
