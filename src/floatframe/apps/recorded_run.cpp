#include "floatframe/apps/recorded_run.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/command.hpp"
#include "floatframe/apps/run_files.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/history/new_channels.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"

namespace floatframe {
namespace {

/// Path of the states; for a run's folder, the file in it.
std::string states_path(const std::string& given) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(given, ignored)) return given;
  const std::filesystem::path states = std::filesystem::path(given) / "states.ffr";
  if (!std::filesystem::exists(states, ignored))
    throw InputError(
        ErrorCode::missing, {states.string(), 0, 0},
        "found no states, expected those of a run that records them (--record states)");
  return states.string();
}

/// Path of the model file: relative to the result as it was when the run was made, or as given.
std::string model_path(const std::string& given, const StateHistory& history) {
  if (!given.empty()) return given;
  const HistoryOrigin& origin = history.header().origin;
  const auto local =
      (std::filesystem::path(history.name()).parent_path() / origin.from_here).lexically_normal();
  std::error_code ignored;
  if (!origin.from_here.empty() && std::filesystem::exists(local, ignored)) return local.string();
  if (std::filesystem::exists(origin.model_file, ignored)) return origin.model_file;
  throw InputError(
      ErrorCode::not_found, {history.name(), 0, 0},
      fmt::format("the model file '{}' does not exist any more; give its path with --model",
                  origin.model_file));
}

void require_same_files(const StateHistory& history, const ModelFingerprint& used,
                        const std::string& path) {
  const HistoryOrigin& origin = history.header().origin;
  const auto files = relative_to_model(path, used.files);
  // The model file may have been renamed.
  const std::string before = std::filesystem::path(origin.model_file).filename().string();
  const std::string after = std::filesystem::path(path).filename().string();
  for (const auto& [file, hash] : origin.files) {
    const auto now = files.find(file == before ? after : file);
    if (now == files.end() || now->second != hash)
      throw InputError(
          ErrorCode::mismatch, {history.name(), 0, 0},
          fmt::format("the states are of a run that was made before '{}' was changed", file));
  }
}

}  // namespace

Option recorded_result_position(RecordedRunArguments& arguments) {
  return file_position("RESULT", arguments.result, "states.ffr of a run, or its folder");
}

Option recorded_model_option(RecordedRunArguments& arguments) {
  return text_option("--model", arguments.model, "FILE",
                     "The model file, if it is not where it was");
}

RecordedRun load_recorded_run(const RecordedRunArguments& arguments) {
  RecordedRun run{StateHistory(states_path(arguments.result)), {}, 0, {}};
  for (const std::string& note : run.history.notes()) say(run.history.name() + ": " + note);
  ModelArguments given;
  given.path = model_path(arguments.model, run.history);
  given.settings = run.history.header().origin.settings;
  ModelFingerprint used;
  run.description = read_model(given, false, &used);
  require_same_files(run.history, used, given.path);
  require_model(run.history, build_model(run.description));
  run.inputs = files_of(used);
  // Additional outputs must not overwrite files of the run.
  const RunPaths own(std::filesystem::path(run.history.name()).parent_path().string());
  for (const std::string& file : {run.history.name(), own.results, own.report, own.summary})
    if (std::error_code ignored; std::filesystem::exists(file, ignored)) run.inputs.push_back(file);
  if (arguments.outputs.empty()) return run;
  const std::size_t before = run.description.outputs.size();
  given.outputs = arguments.outputs;
  run.description = read_model(given, true);
  run.added = run.description.outputs.size() - before;
  return run;
}

SimulationDescription recorded_options(const RecordedRun& run) {
  const HistoryHeader& h = run.history.header();
  SimulationDescription o = run.description.simulation;
  o.coordinates = coordinates_from(h.coordinates);
  o.inertia = inertia_from(h.inertia);
  o.step = h.step;
  o.duration = h.duration;
  o.output_interval = h.output_interval;
  return o;
}

std::vector<Option> SelectionArguments::table() {
  return {
      text_option("--from", from, "SECONDS", "First instant [s]; default: the first"),
      text_option("--to", to, "SECONDS", "Last instant [s]; default: the last"),
      whole_option("--every", taken.every, 1, 1'000'000'000, "Of the recorded instants every N-th"),
      repeated_option("--body", taken.bodies, "NAME", "Only this body; may be repeated")};
}

ExportSelection SelectionArguments::selection() const {
  ExportSelection out = taken;
  const NumberRule any = any_number("s");
  if (!from.empty()) out.from = option_number("--from", from, any);
  if (!to.empty()) out.to = option_number("--to", to, any);
  if (out.from > out.to)
    throw InputError(ErrorCode::contradiction,
                     "found --from " + from + " after --to " + to + ", expected an earlier time");
  return out;
}

}  // namespace floatframe
