// floatframe run: simulates a model and writes results.csv, report.html and summary.json.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model/inertia_choice.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/report/notes_text.hpp"
#include "floatframe/report/report_html.hpp"
#include "floatframe/report/results_csv.hpp"
#include "floatframe/report/summary_json.hpp"
#include "floatframe/simulation/range_warnings.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {
namespace {

struct RunArguments {
  ModelArguments model;
  std::string coordinates, inertia, step, duration, out, write_state;
  bool no_report = false, quiet = false, strict = false;
};

void apply(const RunArguments& arguments, SimulationDescription& simulation) {
  if (!arguments.coordinates.empty()) {
    simulation.coordinates = coordinates_from(arguments.coordinates);
  }
  if (!arguments.inertia.empty()) simulation.inertia = inertia_from(arguments.inertia);
  set_clock(simulation, arguments.step, arguments.duration);
  require_valid_run(simulation);
  check_step(simulation);
}

struct OutputPaths {
  std::string folder, results, report, summary;
};

OutputPaths make_output_paths(const RunArguments& arguments, const std::string& model_name) {
  const std::filesystem::path folder =
      arguments.out.empty() ? std::filesystem::path("out") / file_name_from(model_name)
                            : std::filesystem::path(arguments.out);
  try {
    make_output_folder(folder.string());
  } catch (const OutputError& error) {
    throw InputError(error.what());
  }
  return {folder.string(), (folder / "results.csv").string(), (folder / "report.html").string(),
          (folder / "summary.json").string()};
}

FactTable model_facts(const Model& model) {
  FactTable facts{"Model", {}};
  try {
    const ModelCounts c = check(model);
    const auto coordinates = [](const CoordinateCounts& k) {
      return fmt::format("{} rigid + {} elastic = {}, {}", k.rigid, k.elastic, k.total,
                         plural(k.constraints, "constraint"));
    };
    facts.rows = {{"bodies", fmt::format("{}, {} flexible", c.bodies, c.flexible_bodies)},
                  {"joints", fmt::format("{}, {} cut", c.joints, c.cut_joints)},
                  {"relative coordinates", coordinates(c.relative)},
                  {"absolute coordinates", coordinates(c.absolute)},
                  {"degrees of freedom", std::to_string(c.degrees_of_freedom)}};
  } catch (const RunError& error) {
    facts.rows = {{"coordinates", fmt::format("not counted: {}", error.what())}};
  }
  return facts;
}

std::string start_text(const SimulationDescription& s) {
  if (s.start == Start::given) return "as given";
  const std::string from =
      s.start == Start::equilibrium
          ? std::string("static equilibrium")
          : fmt::format("state at {:g} s from {}", s.state->time, s.state->file);
  return from + (s.offset.empty() ? "" : ", with offsets");
}

FactTable setting_facts(const RunArguments& arguments, const SimulationDescription& s) {
  FactTable facts{"Settings",
                  {{"model file", arguments.model.path},
                   {"coordinates", word(s.coordinates)},
                   {"inertia terms", word(s.inertia)},
                   {"step", fmt::format("{:g} s", s.step)},
                   {"duration asked", fmt::format("{:g} s", s.duration)},
                   {"start", start_text(s)},
                   {"spectral radius at infinity", fmt::format("{:g}", s.spectral_radius)},
                   {"Newton tolerance", fmt::format("{:g}", s.tolerance)},
                   {"Newton iterations at most", std::to_string(s.max_iterations)}}};
  for (const std::string& setting : arguments.model.settings) {
    facts.rows.push_back({"parameter set", setting});
  }
  return facts;
}

void write_outputs(const OutputPaths& paths, const RunArguments& arguments, Report&& report) {
  // The files of one run belong together: what this run does not write must not stay from an
  // earlier one.
  if (report.result.table.columns.empty()) {
    remove_file(paths.results);
  } else {
    write_file(paths.results, results_csv(report.result.table));
  }
  if (arguments.no_report) {
    remove_file(paths.report);
  } else {
    write_file(paths.report, report_html(report));
  }
  write_file(paths.summary, summary_json(report.result.summary));
}

std::string summary_text(const RunSummary& s) {
  return fmt::format(
      "{}: {:g} s simulated in {:.3g} s of processor time ({:.3g} times real time){}\n"
      "  {} coordinates, inertia terms by {}, step {:g} s\n"
      "  {}, {} by halving, {}, {}\n"
      "  largest constraint violation {:.2g} m, {:.2g} m/s\n{}",
      s.model, s.duration, s.cpu, s.real_time_factor,
      s.status == "completed" || s.strict ? "" : ", then it failed", s.coordinates, s.inertia,
      s.step, plural(s.steps, "step"), s.substeps, plural(s.iterations, "Newton iteration"),
      plural(s.factorizations, "factorisation"), s.max_position_violation, s.max_velocity_violation,
      notes_text(s.start.notes));
}

std::string files_text(const OutputPaths& paths, const RunArguments& arguments, bool has_table) {
  std::string text;
  if (has_table) text += fmt::format("  results  {}\n", paths.results);
  if (!arguments.no_report) text += fmt::format("  report   {}\n", paths.report);
  return text + fmt::format("  summary  {}\n", paths.summary);
}

int run_model(const RunArguments& arguments) {
  ModelFingerprint used;
  ModelDescription description = read_model(arguments.model, arguments.quiet, &used);
  apply(arguments, description.simulation);
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  require_writable({{"--write-state", arguments.write_state}}, files_of(used));
  const OutputPaths paths = make_output_paths(arguments, description.name);
  require_writable({{"--write-state", arguments.write_state},
                    {"--out", paths.results},
                    {"--out", paths.report},
                    {"--out", paths.summary}},
                   files_of(used));

  Report report;
  if (!arguments.no_report) report.facts.push_back(model_facts(model));
  RunOptions options;
  options.keep_state = !arguments.write_state.empty();
  try {
    ProgressBar bar(!arguments.quiet, description.simulation.duration, "s");
    options.progress = [&bar](double fraction) { bar.show(fraction); };
    report.result = run(model, description.simulation, options);
  } catch (const RunError& error) {
    // A summary and a report that say so, in place of older results.
    report.result.summary = failed_summary(description.name, description.simulation, error.what());
  }
  report.facts.push_back(setting_facts(arguments, description.simulation));
  report.software = build_description();
  report.processor = processor_name();
  report.spectral_radius = description.simulation.spectral_radius;
  report.result.summary.settings = arguments.model.settings;
  report.result.summary.files = used.files;
  if (arguments.strict) make_strict(report.result.summary);

  const RunSummary summary = report.result.summary;
  const bool state = report.result.state && (summary.status == "completed" || summary.strict);
  if (state) write_file(arguments.write_state, state_json(*report.result.state));
  const bool has_table = !report.result.table.columns.empty();
  write_outputs(paths, arguments, std::move(report));
  if (!arguments.quiet) {
    print((has_table ? summary_text(summary) : "") + files_text(paths, arguments, has_table) +
          (state ? fmt::format("  state    {}\n", arguments.write_state) : ""));
  }
  for (const RangeWarning& warning : summary.warnings) say("warning: " + warning.sentence);
  if (summary.status == "completed") return 0;
  say("the run failed: " + summary.message);
  if (has_table && !summary.strict)
    say(fmt::format("the results up to {:.9g} s are kept in {} and marked as partial",
                    summary.duration, paths.folder));
  return 1;
}

}  // namespace

Command run_command() {
  const auto a = std::make_shared<RunArguments>();
  return {
      .name = "run",
      .help = "Simulate a model; write results, report and summary",
      .options = joined(
          model_options(a->model),
          {coordinates_option(
               a->coordinates,
               "Formulation: relative (joint coordinates) or absolute (natural coordinates)"),
           inertia_option(
               a->inertia,
               "Inertia terms: preprocessing (constant integrals) or projection (all nodes)"),
           text_option("--step", a->step, "SECONDS",
                       "Time step [s]; default: that of the model file"),
           text_option("--duration", a->duration, "SECONDS",
                       "Time to simulate [s]; default: that of the model file"),
           text_option("--out", a->out, "DIR", "Folder for the files; default: out/<model name>"),
           text_option("--write-state", a->write_state, "FILE",
                       "Write the state at the end, for start: {state: FILE}"),
           flag("--no-report", a->no_report, "Do not write report.html"),
           flag("--strict", a->strict, "Warnings count as errors: exit code 1, results are kept"),
           flag("--quiet", a->quiet,
                "No progress bar, no summary; errors and warnings are still shown")}),
      .footer =
          "Files: results.csv (SI units, radians), report.html, summary.json.\n"
          "Exit codes: 0 completed, 1 failed (results up to there are kept) or, with --strict, "
          "with\n"
          "warnings, 2 bad input.",
      .run = [a] { return run_model(*a); }};
}

}  // namespace floatframe
