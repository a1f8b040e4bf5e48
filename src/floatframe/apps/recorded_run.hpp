#pragma once
// A recorded result (states.ffr) and its model, loaded by commands that show or evaluate a run
// without running it again.
#include <string>
#include <vector>

#include "floatframe/apps/command.hpp"
#include "floatframe/core/options.hpp"
#include "floatframe/export/export_selection.hpp"
#include "floatframe/history/state_history.hpp"

namespace floatframe {

/// RESULT and --model, as accepted by the commands.
struct RecordedRunArguments {
  std::string result;                  ///< states.ffr of a run, or its folder
  std::string model{};                 ///< the model file, if it was moved
  std::vector<std::string> outputs{};  ///< additional outputs, in model file syntax
};

Option recorded_model_option(RecordedRunArguments& arguments);
Option recorded_result_position(RecordedRunArguments& arguments);

struct RecordedRun {
  StateHistory history;
  ModelDescription description;     ///< with the additional outputs
  std::size_t added = 0;            ///< number of additional outputs
  std::vector<std::string> inputs;  ///< names of all files that were read
};

/// Checks that the model and all its files are those of the run. Notes on the states are printed on
/// standard error. Throws InputError.
RecordedRun load_recorded_run(const RecordedRunArguments& arguments);

/// The options of the run, including the formulation of its states.
SimulationDescription recorded_options(const RecordedRun& run);

struct SelectionArguments {
  std::string from{}, to{};
  ExportSelection taken{};  ///< filled directly by the options

  std::vector<Option> table();
  /// Throws InputError.
  ExportSelection selection() const;
};

}  // namespace floatframe
