// floatframe outputs: additional channels from the states of a run, without a new simulation.
#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/recorded_run.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/history/new_channels.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/results/results_csv.hpp"

namespace floatframe {
namespace {

struct OutputsArguments {
  RecordedRunArguments run;
  std::string out;
  bool overwrite = false;
};

int outputs(const OutputsArguments& arguments) {
  if (arguments.run.outputs.empty())
    throw InputError(ErrorCode::missing,
                     "found no --add, expected a channel as a model file writes it");
  const RecordedRun run = load_recorded_run(arguments.run);
  require_writable({{"--out", arguments.out}}, run.inputs, arguments.overwrite);
  const Model model = build_model(run.description);
  for (const std::string& note : doubtful_gauges(model, model.outputs.size() - run.added))
    say("note: " + note);
  ResultTable table;
  try {
    const ListenToProgress listen(progress_on_terminal(true));
    table = new_channels(run.history, model, recorded_options(run), run.added);
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
          .options = {recorded_result_position(a->run),
                      repeated_option("--add", a->run.outputs, "CHANNEL",
                                      "A channel as in outputs of a model file, for example 'tip: "
                                      "{position: {body: arm, node: BALL}}'; may be repeated"),
                      recorded_model_option(a->run),
                      text_option("--out", a->out, "FILE",
                                  "File for the table (CSV); default: standard output"),
                      overwrite_option(a->overwrite)},
          .footer =
              "The model file and all files that it names must be unchanged since the run.\n"
              "Exit codes: 0 done, 1 the model cannot be started, 2 bad input.",
          .run = [a] { return outputs(*a); }};
}

}  // namespace floatframe
