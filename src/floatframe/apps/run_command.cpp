// floatframe run: simulates a model and writes results.csv, report.html and summary.json.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/run_files.hpp"
#include "floatframe/apps/stop_signal.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/history/history_content.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/page/run_page.hpp"
#include "floatframe/results/notes_text.hpp"
#include "floatframe/results/results_reader.hpp"
#include "floatframe/results/verification_report.hpp"
#include "floatframe/run/range_warnings.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/run/verification.hpp"
#include "floatframe/sweep/sweep_identity.hpp"

namespace floatframe {
namespace {

struct RunArguments {
  ModelArguments model;
  std::string coordinates, inertia, step, duration, out, write_state;
  std::string checkpoint_every, record;
  bool resume = false, no_report = false, quiet = false, strict = false, overwrite = false;
  bool verify = false;
};

void apply(const RunArguments& arguments, SimulationDescription& simulation) {
  set_formulation(simulation, arguments.coordinates, arguments.inertia);
  set_time_options(simulation, arguments.step, arguments.duration);
  using States = RecordDescription::States;
  if (!arguments.record.empty())
    simulation.record.states = arguments.record == "none" ? States::none : States::states;
  require_valid_run(simulation);
  check_step(simulation);
}

RunPaths make_paths(const RunArguments& arguments, const std::string& model_name) {
  const std::filesystem::path folder =
      arguments.out.empty() ? std::filesystem::path("out") / file_name_from(model_name)
                            : std::filesystem::path(arguments.out);
  require_folder(folder.string());
  return RunPaths(folder.string());
}

std::string edges_text(const RunSummary& s) {
  std::string text;
  if (s.locates_edges) text = fmt::format("  {} located", plural(s.edges, "edge"));
  if (s.edges_passed > 0)
    text += fmt::format(", {} with too many to locate", plural(s.edges_passed, "step"));
  if (!text.empty()) text += '\n';
  if (s.corners > 0)
    text += fmt::format("  {} of functions of time located\n", plural(s.corners, "corner"));
  return text;
}

std::string loads_text(const RunSummary& s) {
  if (!(s.max_load_contraction > 0.0)) return "";
  return fmt::format("  normal forces of reactions contract by {:.2g} in an iteration\n",
                     s.max_load_contraction);
}

std::string summary_text(const RunSummary& s) {
  return fmt::format(
      "{}: {:g} s simulated in {:.3g} s of processor time ({:.3g} times real time at steps of {:g} "
      "ms){}\n"
      "{}  {} coordinates, inertia terms by {}, step {:g} s\n"
      "  {}, {} by halving, {}, {}\n"
      "{}{}  largest constraint violation {:.2g} m, {:.2g} m/s\n{}",
      s.model, s.duration, s.cpu, s.real_time_factor, 1e3 * s.step,
      s.status == "completed" || s.strict ? ""
      : s.status == "interrupted"         ? ", then it was interrupted"
                                          : ", then it failed",
      s.until.empty() ? "" : "  " + until_text(s) + "\n", s.coordinates, s.inertia, s.step,
      plural(s.steps, "step"), s.substeps, plural(s.iterations, "Newton iteration"),
      plural(s.factorizations, "factorisation"), edges_text(s), loads_text(s),
      s.max_position_violation, s.max_velocity_violation, notes_text(s.start.notes));
}

std::string files_text(const RunPaths& paths, bool has_table, bool no_report) {
  std::string text;
  if (has_table) text += fmt::format("  results  {}\n", paths.results);
  if (std::filesystem::exists(paths.states)) text += fmt::format("  states   {}\n", paths.states);
  if (std::filesystem::exists(paths.report)) text += fmt::format("  report   {}\n", paths.report);
  if (page_template().empty() && !no_report)
    text += "  report   none: this program was built without the page\n";
  return text + fmt::format("  summary  {}\n", paths.summary);
}

HistoryOrigin origin_of(const RunArguments& arguments, const ModelFingerprint& used,
                        const RunPaths& paths) {
  HistoryOrigin o = history_origin(arguments.model.path, paths.folder);
  o.settings = arguments.model.settings;
  o.files = relative_to_model(arguments.model.path, used.files);
  o.text = used.text;
  return o;
}

RunFiles::Options run_file_options(const RunArguments& arguments, const ModelFingerprint& used,
                                   const ModelDescription& description, const Model& model,
                                   const RunPaths& paths) {
  RunFiles::Options o;
  o.model = &model;
  o.simulation = &description.simulation;
  if (description.simulation.record.states != RecordDescription::States::none)
    o.history = [&](const StateLayout& layout) {
      return history_content(model, description.simulation, layout,
                             origin_of(arguments, used, paths));
    };
  o.report = !arguments.no_report;
  o.resume = arguments.resume;
  o.overwrite = arguments.overwrite;
  if (!arguments.checkpoint_every.empty())
    // No checkpoint is due after the end of the run.
    o.checkpoint_every = std::min(positive_number("--checkpoint-every", arguments.checkpoint_every),
                                  2.0 * description.simulation.duration);
  o.summary = asked_summary(description.name, description.simulation);
  o.summary.duration = description.simulation.duration;
  o.summary.settings = arguments.model.settings;
  o.summary.files = used.files;
  if (o.resume || o.checkpoint_every > 0.0)
    o.origin = {program_identity(), relative_to_model(arguments.model.path, used.files),
                arguments.model.settings};
  return o;
}

/// The run, with its files written while it runs.
RunResult run_with(RunFiles& files, const Model& model, const SimulationDescription& simulation,
                   const RunArguments& arguments) {
  RunOptions options;
  options.keep_state = !arguments.write_state.empty();
  options.stop = &StopSignal::flag();
  options.resume = files.resumed();
  options.checkpoint_every = files.checkpoint_every();
  if (files.streams()) {
    options.rows = [&](const std::vector<Column>& columns, std::span<const double> numbers) {
      files.take(columns, numbers);
    };
    if (files.keeps_states())
      options.states = [&](const StateLayout& layout, std::span<const double> numbers) {
        files.take_states(layout, numbers);
      };
    options.checkpoint = [&](const RunCheckpoint& checkpoint) { files.keep(checkpoint); };
  }
  const ListenToProgress start(progress_on_terminal(!arguments.quiet));
  ProgressBar bar(!arguments.quiet, simulation.duration, "s");
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  return run(model, simulation, options);
}

/// Prints the closing messages; returns the exit code.
int end_of(const RunPaths& paths, const RunSummary& summary, bool has_table,
           const std::vector<std::string>& unwritten, const RunFiles& files) {
  const std::optional<double> cut_at = files.cut_at();
  for (const RangeWarning& warning : summary.warnings) say("warning: " + warning.sentence);
  const bool interrupted = summary.status == "interrupted";
  if (interrupted)
    say(summary.message);
  else if (summary.status != "completed")
    say_error("the run failed: " + summary.message);
  if (summary.status != "completed" && has_table && !summary.strict)
    say(fmt::format("the results up to {:.9g} s are kept in {} and marked as partial",
                    cut_at.value_or(summary.duration), paths.folder));
  if (summary.verification)
    for (const std::string& sentence : summary.verification->sentences)
      say("verification: " + sentence);
  // After a failed step there is no hint to resume: the step would fail again.
  if ((interrupted || cut_at) && std::filesystem::exists(paths.checkpoint))
    say("the same command with --resume continues the run");
  if (const std::string kept = files.kept_sentence(); !kept.empty()) say(kept);
  for (const std::string& sentence : unwritten) say(sentence);
  if ((interrupted || (summary.verification && summary.verification->interrupted)) &&
      unwritten.empty())
    return 128 + StopSignal::number();
  return summary.status == "completed" && unwritten.empty() ? exit_code::done : exit_code::failed;
}

/// For a run to be resumed that has already completed.
int complete_before(const RunArguments& arguments, const RunPaths& paths) {
  const std::string text =
      fmt::format("the run in '{}' is complete, there is nothing to continue", paths.folder);
  if (!arguments.write_state.empty())
    throw InputError(ErrorCode::unknown_key,
                     fmt::format("--write-state: {}; its state at the end is not known", text));
  if (arguments.verify)
    throw InputError(ErrorCode::exists,
                     fmt::format("--verify: {}; without --resume it is made and verified", text));
  say(text);
  return exit_code::done;
}

void require_verifiable(const SimulationDescription& simulation) {
  if (!(simulation.duration > 0.0))
    throw InputError(ErrorCode::out_of_range,
                     "--verify: found a duration of 0 s, expected one with steps to halve");
}

/// The rows of the run: those on disk if it wrote them there.
NextRow next_row(const RunFiles& files, const RunPaths& paths, const ResultTable& table) {
  if (!files.streams()) return rows_of(table);
  const auto reader = std::make_shared<ResultsReader>(paths.results);
  return [reader] { return reader->next() ? reader->row().data() : nullptr; };
}

/// Verifies a run whose files are complete, and adds the result to these. Each failure is a
/// sentence in the result.
std::vector<std::string> verify(const RunArguments& arguments, RunFiles& files,
                                const RunPaths& paths, const Model& model,
                                const SimulationDescription& simulation, Report& report) {
  RunSummary& summary = report.result.summary;
  if (summary.status == "interrupted" || summary.steps == 0 || files.cut_at()) {
    say("--verify: the run did not come to its end, so it is not verified");
    return {};
  }
  RunOptions options;
  options.stop = &StopSignal::flag();
  {
    ProgressBar bar(!arguments.quiet, 1.0, "");
    options.progress = [&bar](double fraction) { bar.show(fraction, "verification"); };
    summary.verification = verify_steps(model, simulation, summary.duration,
                                        next_row(files, paths, report.result.table), options);
  }
  return files.rewrite(report);
}

using WallClock = std::chrono::steady_clock;

std::string wall_text(WallClock::time_point begin, WallClock::time_point computed) {
  const auto seconds = [](WallClock::time_point a, WallClock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
  };
  const WallClock::time_point now = WallClock::now();
  return fmt::format("  wall time {:.3g} s, {:.2g} s of it for results and report\n",
                     seconds(begin, now), seconds(computed, now));
}

int run_model(const RunArguments& arguments) {
  const WallClock::time_point begin = WallClock::now();
  ModelFingerprint used;
  ModelDescription description = read_model(arguments.model, arguments.quiet, &used);
  apply(arguments, description.simulation);
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  require_writable({{"--write-state", arguments.write_state}}, files_of(used), arguments.overwrite);
  if (arguments.verify) require_verifiable(description.simulation);
  const RunPaths paths = make_paths(arguments, description.name);
  require_writable({{"--write-state", arguments.write_state},
                    {"--out", paths.results},
                    {"--out", paths.states},
                    {"--out", paths.report},
                    {"--out", paths.summary},
                    {"--out", paths.checkpoint}},
                   files_of(used), true);  // RunFiles checks who wrote them
  RunFiles files(paths, run_file_options(arguments, used, description, model, paths));
  if (files.complete()) return complete_before(arguments, paths);
  const StopSignal stop_signal;

  Report report;
  if (!arguments.no_report) describe_model(model, report);
  try {
    report.result = run_with(files, model, description.simulation, arguments);
  } catch (const RunError& error) {
    // A summary and a report with the error replace older results.
    report.result.summary = failed_summary(description.name, description.simulation, error.what());
  }
  const WallClock::time_point computed = WallClock::now();
  report.subjects = channel_subjects(model);
  report.facts.push_back(
      setting_facts(arguments.model.path, arguments.model.settings, description.simulation));
  report.software = build_description();
  report.processor = processor_name();
  report.result.summary.settings = arguments.model.settings;
  report.result.summary.files = used.files;
  if (arguments.strict) make_strict(report.result.summary);

  const RunSummary& summary = report.result.summary;
  const bool state = report.result.state && (summary.status == "completed" || summary.strict);
  const bool has_table = !report.result.table.columns.empty();
  std::vector<std::string> unwritten = files.finish(report);
  if (state) {
    try {
      write_file(arguments.write_state, state_json(*report.result.state));
    } catch (const OutputError& error) {
      unwritten.emplace_back(error.what());
    }
  }
  const std::string wall = wall_text(begin, computed);
  if (arguments.verify && unwritten.empty() && !files.untouched())
    unwritten = verify(arguments, files, paths, model, description.simulation, report);
  if (!arguments.quiet && !files.untouched())
    print((has_table ? summary_text(summary) : "") +
          files_text(paths, has_table, arguments.no_report) +
          (state ? fmt::format("  state    {}\n", arguments.write_state) : "") + wall +
          (summary.verification ? verification_text(*summary.verification) : ""));
  return end_of(paths, summary, has_table, unwritten, files);
}

}  // namespace

Command run_command() {
  const auto a = std::make_shared<RunArguments>();
  return {
      .name = "run",
      .help = "Simulate a model; write results, report and summary",
      .options = joined(
          joined(joined(model_options(a->model),
                        {coordinates_option(a->coordinates), inertia_option(a->inertia)}),
                 clock_options(a->step, a->duration)),
          {text_option("--out", a->out, "DIR", "Folder for the files; default: out/<model name>"),
           text_option("--write-state", a->write_state, "FILE",
                       "Write the state at the end, for start: {state: FILE}"),
           text_option("--checkpoint-every", a->checkpoint_every, "SECONDS",
                       "Write a checkpoint to DIR/run.checkpoint every so many seconds of "
                       "simulated time [s]"),
           flag("--resume", a->resume,
                "Continue from the checkpoint in DIR: same model, options and copy of the program"),
           flag("--overwrite", a->overwrite,
                "Begin anew where a run in DIR is unfinished; replace files that were not written "
                "by this program"),
           word_option("--record", a->record, {"states", "none"},
                       "Record the states of the run in DIR/states.ffr, or not; default: as in the "
                       "model file, else states"),
           flag("--no-report", a->no_report, "Do not write report.html"),
           flag("--verify", a->verify,
                "Make the run again at a half and a quarter of the step: difference, order and "
                "estimated error of each output; about seven times the time"),
           flag("--strict", a->strict, "Warnings count as errors: exit code 1, results are kept"),
           flag("--quiet", a->quiet,
                "No progress bar, no summary; errors and warnings are still shown")}),
      .footer =
          "Files: results.csv (SI units, radians) and states.ffr, which are written during "
          "the run,\n"
          "report.html, summary.json. Ctrl-C ends the run with its files.\n"
          "A completed run in DIR is replaced once the new one is complete; until then it is kept "
          "in\n"
          "DIR/previous.\n"
          "Exit codes: 0 completed, 1 failed (results up to there are kept) or, with --strict, "
          "with\n"
          "warnings, 2 bad input, 128 + signal interrupted (130 for Ctrl-C, 143 for SIGTERM).",
      .run = [a] { return run_model(*a); }};
}

}  // namespace floatframe
