// floatframe sweep: a parameter study in worker processes, under mpirun on several machines.
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <filesystem>
#include <optional>
#include <thread>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/own_file.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/stop_signal.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/sweep/process_memory.hpp"
#include "floatframe/sweep/sweep_ranks.hpp"
#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {
namespace {

struct SweepArguments {
  ModelArguments model;
  std::vector<std::string> vary, measures;
  std::string files_in, table, out, coordinates, inertia, step, duration, case_timeout, case_memory;
  std::string report, minimize, maximize;
  int threads = 0;
  bool keep_results = false, fresh = false, retry_failed = false, strict = false, quiet = false,
       overwrite = false;
};

/// Processors available to this process, shared with other processes of the study on this host.
int processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
  if (count <= 0) count = static_cast<int>(std::thread::hardware_concurrency());
  // Unless the launcher has bound each process to specific processors.
  const int all = static_cast<int>(std::thread::hardware_concurrency());
  if (count == all) count /= ranks_on_this_machine();
  return std::max(1, count);
}

/// 0 if not given.
double megabytes(const std::string& text) {
  if (text.empty()) return 0.0;
  const double value = option_number("--case-memory", text, positive_number("MB"));
  if (!(memory_of(::getpid()) > 0.0))
    throw InputError(ErrorCode::unavailable,
                     "--case-memory: /proc does not show how much memory a process uses");
  return value;
}

/// The files of a study and of the runs it records.
void require_own_study(const std::filesystem::path& folder) {
  for (const char* name : {"sweep.csv", "sweep.journal"})
    require_own({"--out", (folder / name).string()});
  for (const char* run : {"best", "worst"})
    for (const char* name : {"summary.json", "states.ffr", "report.html"})
      require_own({"--out", (folder / run / name).string()});
  std::error_code ignored;
  for (std::filesystem::directory_iterator it(folder / "runs", ignored), end; !ignored && it != end;
       it.increment(ignored)) {
    if (it->path().filename().string().find_first_not_of("0123456789") != std::string::npos)
      continue;
    for (const char* name : {"summary.json", "states.ffr"})
      require_own({"--out", (it->path() / name).string()});
    if (const std::string results = (it->path() / "results.csv").string(); !is_own_results(results))
      refuse_foreign("--out", results);
  }
}

/// The page shows curves, so that the results of all runs are kept.
void set_page(const SweepArguments& a, SweepOptions& o) {
  for (const auto& [option, text] :
       {std::pair{"--minimize", &a.minimize}, {"--maximize", &a.maximize}}) {
    if (text->empty()) continue;
    if (a.report.empty())
      throw InputError(ErrorCode::missing,
                       fmt::format("{} ranks the runs of a page, expected --report", option));
    if (o.ranking)
      throw InputError(ErrorCode::exclusive,
                       "--minimize and --maximize exclude each other; remove one of them");
    o.ranking = sweep_ranking(option, *text, text == &a.maximize);
    // It is a column of the table even if others were asked for.
    if (!o.measures.empty()) o.measures.push_back(o.ranking->measure);
  }
  if (a.report.empty()) return;
  o.report = a.report;
  o.keep_results = true;
  if (!a.overwrite) require_own({"--report", a.report});
}

SweepOptions options_from(const SweepArguments& a) {
  SweepOptions o;
  o.model = a.model.path;
  if (!a.files_in.empty()) {
    const std::filesystem::path file(a.model.path);
    std::string& text = o.text.emplace();
    if (const std::string error = read_regular_file(file, largest_file_read, text); !error.empty())
      throw InputError(ErrorCode::wrong_value, {a.model.path, 0, 0}, error);
    o.model = (std::filesystem::path(a.files_in) / file.filename()).string();
  }
  for (const std::string& setting : a.model.settings) {
    const auto [name, value] = setting_of(setting);
    o.fixed.push_back({name, value});
  }
  const auto fix = [&](const char* name, const std::string& value) {
    if (!value.empty()) o.fixed.push_back({std::string("simulation.") + name, value});
  };
  fix("coordinates", a.coordinates);
  fix("inertia", a.inertia);
  if (!a.step.empty()) positive_number("--step", a.step);
  fix("step", a.step);
  if (!a.duration.empty()) positive_number("--duration", a.duration);
  fix("duration", a.duration);
  if (a.vary.empty() == a.table.empty())
    throw InputError(a.vary.empty() ? ErrorCode::missing : ErrorCode::exclusive,
                     a.vary.empty() ? "expected --vary or --table: what changes from run to run"
                                    : "--vary and --table exclude each other; remove one of them");
  o.plan = a.table.empty() ? grid_plan(a.vary) : table_plan(a.table);
  for (const std::string& m : a.measures) o.measures.push_back(sweep_measure(m));
  o.threads = a.threads > 0 ? a.threads : processors();
  o.keep_results = a.keep_results;
  set_page(a, o);
  o.fresh = a.fresh;
  o.retry_failed = a.retry_failed;
  o.strict = a.strict;
  if (!a.case_timeout.empty()) o.limits.seconds = positive_number("--case-timeout", a.case_timeout);
  o.limits.megabytes = megabytes(a.case_memory);
  o.folder = a.out;
  if (o.folder.empty()) {
    const std::string stem = std::filesystem::path(o.model).stem().string();
    o.folder = (std::filesystem::path("out") / (file_name_from(stem) + "_sweep")).string();
  }
  const std::filesystem::path folder(o.folder);
  require_distinct({{"--out", (folder / "sweep.csv").string()}}, {a.table});
  if (!a.overwrite) require_own_study(folder);
  return o;
}

std::string report_text(const SweepReport& r, double seconds, int at_a_time, int ranks) {
  std::string where = fmt::format("{} at a time", at_a_time);
  if (ranks > 1) where += fmt::format(" in each of {} processes", ranks);
  const std::size_t now = r.runs - r.before;
  std::string text =
      now == 0
          ? fmt::format("all {} were finished before\n", plural(static_cast<long>(r.runs), "run"))
          : fmt::format("{} in {:.3g} s, {}{}\n", plural(static_cast<long>(now), "run"), seconds,
                        where,
                        r.before > 0 ? fmt::format(", {} were finished before", r.before) : "");
  text += fmt::format("  table    {}\n  journal  {}\n", r.table, r.journal);
  if (!r.page.empty()) text += fmt::format("  page     {}\n", r.page);
  return text;
}

/// The number of runs that left the range of the method, and the first sentence of each kind.
void say_warnings(const SweepReport& r) {
  if (r.warned == 0) return;
  const std::string runs = plural(static_cast<long>(r.runs), "run");
  say(fmt::format("warning: {} of {} left the range of the method", r.warned, runs));
  for (const SweepWarnings& w : r.warnings)
    say(fmt::format("warning: run {}{}: {}", w.first,
                    w.runs > 1 ? fmt::format(" (and {} more)", w.runs - 1) : "", w.sentence));
}

int lead_study(const SweepArguments& arguments, const SweepOptions& options, SweepWorkers& workers,
               Ranks* ranks) {
  const auto start = std::chrono::steady_clock::now();
  SweepReport report;
  {
    ProgressBar bar(!arguments.quiet, 1.0, "");
    auto shown = start - std::chrono::seconds(1);
    report = run_sweep(options, workers, ranks, StopSignal::flag(), [&](const SweepProgress& p) {
      const auto now = std::chrono::steady_clock::now();
      if (now - shown < std::chrono::milliseconds(100)) return;
      shown = now;
      const auto total = static_cast<double>(std::max<std::size_t>(1, p.total));
      const bool checking = p.stage == SweepProgress::Stage::checking;
      bar.show((static_cast<double>(p.done) + p.in_work) / total,
               fmt::format("{} of {} runs{}", p.done, p.total, checking ? " checked" : ""),
               static_cast<double>(p.before) / total);
    });
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  if (report.interrupted) {
    say(fmt::format("interrupted: {} of {} finished; the same command continues", report.finished,
                    plural(static_cast<long>(report.runs), "run")));
    return 1;
  }
  if (!arguments.quiet)
    print(report_text(report, passed.count(), options.threads, ranks ? ranks->size() : 1));
  say_warnings(report);
  if (report.failed == 0) return 0;
  say(fmt::format("{} of {} failed, the first is run {}: {}", report.failed,
                  plural(static_cast<long>(report.runs), "run"), report.first_failed,
                  report.first_message));
  return 1;
}

int sweep(const SweepArguments& arguments) {
  // Worker processes first: they are forked, and MPI creates threads and locks.
  std::optional<SweepOptions> options;
  std::optional<SweepWorkers> workers;
  std::exception_ptr error;
  try {
    options = options_from(arguments);
    workers.emplace(*options);
  } catch (...) {
    error = std::current_exception();
  }
  std::unique_ptr<Ranks> ranks;
  if (started_on_ranks()) ranks = open_ranks();
  int code = 0;
  {
    const StopSignal signals(SA_RESTART);
    if (ranks && ranks->rank() > 0) {
      // Process 0 reports invalid arguments.
      serve_sweep(options ? *options : SweepOptions{}, workers ? &*workers : nullptr, *ranks,
                  StopSignal::flag());
      return 0;
    }
    try {
      if (error) std::rethrow_exception(error);
      code = lead_study(arguments, *options, *workers, ranks.get());
    } catch (...) {
      if (ranks) dismiss_ranks(*ranks);
      throw;
    }
    if (ranks) dismiss_ranks(*ranks);
  }
  workers.reset();
  // Tells the caller that a signal ended the program; a launcher would take that for a crash.
  if (StopSignal::flag().load() && code != 0 && !ranks) std::raise(StopSignal::number());
  return code;
}

}  // namespace

Command sweep_command() {
  const auto a = std::make_shared<SweepArguments>();
  return {
      .name = "sweep",
      .help = "Run a model many times with different values; one row of results per run",
      .options =
          {file_position("MODEL", a->model.path, "Model file (YAML) or packed model (.ffm)"),
           text_option(
               "--files-in", a->files_in, "DIR",
               "Where files are that the model names; default: the folder of the model file"),
           repeated_option("--vary", a->vary, "NAME=VALUES",
                           "Values to vary: LO:HI:N (N values), LO:HI:N:log or A,B,C; repeated: "
                           "all combinations"),
           text_option(
               "--table", a->table, "FILE",
               "Instead of --vary: CSV file, names in the first line, then one run per line"),
           repeated_option("--set", a->model.settings, "NAME=VALUE",
                           "Set a parameter for all runs; may be repeated"),
           repeated_option(
               "--measure", a->measures, "OUTPUT[:STATISTIC]",
               "Only these outputs in the table: final, min, time_of_min, max, time_of_max or rms; "
               "may be repeated; default: all statistics of all outputs"),
           whole_option(
               "--threads", a->threads, 1, 4096,
               "Runs at a time, each in a process of its own; default: number of processors"),
           coordinates_option(a->coordinates, "relative or absolute, for all runs"),
           inertia_option(a->inertia, "preprocessing or projection, for all runs"),
           text_option("--step", a->step, "SECONDS", "Time step of all runs [s]"),
           text_option("--duration", a->duration, "SECONDS", "Time to simulate in all runs [s]"),
           text_option("--out", a->out, "DIR",
                       "Folder for the files; default: out/<file name>_sweep"),
           flag("--keep-results", a->keep_results,
                "Keep results.csv and summary.json of every run below DIR/runs"),
           text_option("--report", a->report, "FILE",
                       "Write a page: main effects, scatter, curves of the runs, table; keeps the "
                       "results of every run"),
           text_option("--minimize", a->minimize, "OUTPUT:STATISTIC",
                       "The best run has the smallest of these; it and the worst get a page each, "
                       "DIR/best and DIR/worst"),
           text_option("--maximize", a->maximize, "OUTPUT:STATISTIC",
                       "The same, the best run has the largest"),
           flag("--fresh", a->fresh, "Do not continue the study in DIR: start again"),
           flag("--retry-failed", a->retry_failed, "Continue, and repeat the runs that failed"),
           flag("--strict", a->strict,
                "A run with warnings counts as failed; its figures are kept"),
           overwrite_option(a->overwrite),
           text_option("--case-timeout", a->case_timeout, "SECONDS",
                       "A run that takes longer is stopped and counts as failed"),
           text_option("--case-memory", a->case_memory, "MB",
                       "A run that needs more memory is stopped and counts as failed [MB]"),
           flag("--quiet", a->quiet,
                "No progress bar, no summary; errors and warnings are still shown")},
      .footer =
          "NAME is a parameter of the model file or else a simulation option: coordinates, "
          "inertia,\n"
          "start, step, duration, output_interval, spectral_radius, tolerance, ... "
          "(simulation.step if\n"
          "the file has a parameter of that name too).\n"
          "Files: DIR/sweep.csv, identical byte by byte whatever the number of threads and "
          "processes;\n"
          "DIR/sweep.journal, from which an interrupted study continues when the command is "
          "repeated.\n"
          "A run that crashes gets a row with \"failed\" and the reason; the study goes on.\n"
          "`mpirun -n 4 floatframe sweep ...` spreads the runs over processes.\n"
          "Exit codes: 0 completed, 1 a run failed or the study was interrupted, 2 bad input.",
      .run = [a] { return sweep(*a); }};
}

}  // namespace floatframe
