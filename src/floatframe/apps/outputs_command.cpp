// floatframe outputs: new channels from the states of a run, without running again.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/run_checkpoint.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/history/new_channels.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/report/results_csv.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe {
namespace {

struct OutputsArguments {
  std::string result, model, out;
  std::vector<std::string> add;
};

/// A run's folder stands for its states.
std::string states_path(const std::string& given) {
  std::error_code ignored;
  return std::filesystem::is_directory(given, ignored)
             ? (std::filesystem::path(given) / "states.ffr").string()
             : given;
}

/// Where the model file is: beside the result as it was when the run was made, or as it was given.
std::string model_path(const OutputsArguments& arguments, const StateHistory& history) {
  if (!arguments.model.empty()) return arguments.model;
  const HistoryOrigin& origin = history.header().origin;
  const auto beside =
      (std::filesystem::path(history.name()).parent_path() / origin.from_here).lexically_normal();
  std::error_code ignored;
  if (!origin.from_here.empty() && std::filesystem::exists(beside, ignored)) return beside.string();
  if (std::filesystem::exists(origin.model_file, ignored)) return origin.model_file;
  throw InputError({history.name(), 0, 0},
                   fmt::format("found no model file '{}' any more, expected its place with --model",
                               origin.model_file));
}

void require_same_files(const StateHistory& history, const ModelFingerprint& used,
                        const std::string& path) {
  const HistoryOrigin& origin = history.header().origin;
  const auto files = relative_to_model(path, used.files);
  for (const auto& [file, hash] : origin.files) {
    const auto now = files.find(file);
    if (now == files.end() || now->second != hash)
      throw InputError(
          {history.name(), 0, 0},
          fmt::format("the states are of a run that was made before '{}' was changed", file));
  }
}

SimulationDescription run_options_of(const StateHistory& history, SimulationDescription o) {
  const HistoryHeader& h = history.header();
  o.coordinates = coordinates_from(h.coordinates);
  o.inertia = inertia_from(h.inertia);
  o.step = h.step;
  o.duration = h.duration;
  o.output_interval = h.output_interval;
  return o;
}

int outputs(const OutputsArguments& arguments) {
  if (arguments.add.empty())
    throw InputError("found no --add, expected a channel as a model file writes it");
  const StateHistory history(states_path(arguments.result));
  for (const std::string& note : history.notes()) say(history.name() + ": " + note);
  ModelArguments given;
  given.path = model_path(arguments, history);
  given.settings = history.header().origin.settings;
  ModelFingerprint used;
  const ModelDescription before = read_model(given, false, &used);
  require_same_files(history, used, given.path);
  require_model(history, build_model(before));
  given.outputs = arguments.add;
  const ModelDescription description = read_model(given, true);
  std::vector<std::string> inputs = files_of(used);
  inputs.push_back(history.name());
  require_writable({{"--out", arguments.out}}, inputs);
  const Model model = build_model(description);
  ResultTable table;
  try {
    table = new_channels(history, model, run_options_of(history, description.simulation),
                         description.outputs.size() - before.outputs.size());
  } catch (const RunError& error) {
    say(std::string("the model cannot be started: ") + error.what());
    return exit_code::failed;
  }
  if (arguments.out.empty())
    print(results_csv(table));
  else
    write_file(arguments.out, results_csv(table));
  return exit_code::done;
}

}  // namespace

Command outputs_command() {
  const auto a = std::make_shared<OutputsArguments>();
  return {.name = "outputs",
          .help = "New channels from the states of a run, without running again",
          .options = {file_position("RESULT", a->result, "states.ffr of a run, or its folder"),
                      repeated_option("--add", a->add, "CHANNEL",
                                      "A channel as in outputs of a model file, for example 'tip: "
                                      "{position: {body: arm, node: BALL}}'; may be repeated"),
                      text_option("--model", a->model, "FILE",
                                  "The model file, if it is not where it was"),
                      text_option("--out", a->out, "FILE",
                                  "File for the table (CSV); default: standard output")},
          .footer =
              "The model file and all that it refers to must be as they were in the run.\n"
              "Exit codes: 0 done, 1 the model cannot be started, 2 bad input.",
          .run = [a] { return outputs(*a); }};
}

}  // namespace floatframe
