// A command for each analysis: reads and builds the model, runs the analysis, prints the result.
#include <fmt/format.h>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"

namespace floatframe {
namespace {

struct AnalysisArguments {
  ModelArguments model;
  std::string step, duration;
  bool json = false, strict = false, overwrite = false;
  std::vector<std::string> files;  ///< their names, in the order of `Analysis::files`
};

/// For analyses that run the model, perhaps many times.
void require_steps(const SimulationDescription& simulation) {
  if (simulation.duration > 1e7 * simulation.step)
    throw InputError(ErrorCode::too_large, mark_of_time_settings(simulation),
                     fmt::format("a duration of {:g} s with a step of {:g} s takes more than 1e+07 "
                                 "steps; give a shorter --duration",
                                 simulation.duration, simulation.step));
  if (!(simulation.duration >= simulation.step))
    throw InputError(ErrorCode::out_of_range, mark_of_time_settings(simulation),
                     "the run is shorter than one step; give a --duration");
}

std::vector<OutputFile> output_files(const Analysis& analysis, const AnalysisArguments& a) {
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < analysis.files.size(); ++k)
    files.push_back({analysis.files[k].option, a.files[k]});
  return files;
}

/// After a failure, files with the error message replace older ones.
AnalysisReport run_with_files(const Analysis& analysis, const Model& model,
                              const AnalysisArguments& a) {
  try {
    const ListenToProgress listen(progress_on_terminal(true));
    return analysis.run(model);
  } catch (const RunError& error) {
    for (std::size_t k = 0; analysis.file_of_failure && k < a.files.size(); ++k)
      if (!a.files[k].empty())
        write_file(a.files[k], analysis.file_of_failure(model, k, error.what()));
    throw;
  }
}

int run_analysis(const Analysis& analysis, const AnalysisArguments& a) {
  ModelFingerprint used;
  ModelDescription description = read_model(a.model, false, &used);
  require_writable(output_files(analysis, a), files_of(used), a.overwrite);
  if (analysis.makes_steps) {
    set_time_options(description.simulation, a.step, a.duration);
    require_steps(description.simulation);
  }
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  const AnalysisReport report = run_with_files(analysis, model, a);
  for (std::size_t k = 0; k < a.files.size(); ++k)
    if (!a.files[k].empty()) write_file(a.files[k], report.files.at(k)());
  print(a.json ? report.json : report.text);
  for (const std::string& warning : report.warnings) say("warning: " + warning);
  if (report.warnings.empty() || !a.strict) return exit_code::done;
  say(fmt::format("the {} counts as failed: {} under --strict", analysis.strict,
                  plural(static_cast<long>(report.warnings.size()), "warning counts as an error",
                         "warnings count as errors")));
  return exit_code::failed;
}

Command analysis_command(const Analysis& analysis) {
  const auto a = std::make_shared<AnalysisArguments>();
  a->files.resize(analysis.files.size());
  std::vector<Option> options = model_options(a->model);
  if (analysis.makes_steps) options = joined(options, clock_options(a->step, a->duration));
  options = joined(options, analysis.options);
  options.push_back(flag("--json", a->json, analysis.json_help));
  for (std::size_t k = 0; k < analysis.files.size(); ++k)
    options.push_back(
        text_option(analysis.files[k].option, a->files[k], "FILE", analysis.files[k].help));
  if (!analysis.files.empty()) options.push_back(overwrite_option(a->overwrite));
  if (!analysis.strict.empty())
    options.push_back(flag("--strict", a->strict, "Warnings count as errors: exit code 1"));
  return {.name = analysis.name,
          .help = analysis.help,
          .options = std::move(options),
          .footer = analysis.footer,
          .run = [analysis, a] { return run_analysis(analysis, *a); }};
}

}  // namespace

std::vector<Command> analysis_commands() {
  std::vector<Command> commands;
  for (const Analysis& analysis : all_analyses()) commands.push_back(analysis_command(analysis));
  return commands;
}

}  // namespace floatframe
