#pragma once
// A result that was kept (states.ffr) with the model it is of: what commands load that show or
// measure a run without running it again.
#include <string>
#include <vector>

#include "floatframe/apps/command.hpp"
#include "floatframe/core/options.hpp"
#include "floatframe/export/export_selection.hpp"
#include "floatframe/history/state_history.hpp"

namespace floatframe {

/// RESULT and --model, as the commands take them.
struct RecordedRunArguments {
  std::string result;                  ///< states.ffr of a run, or its folder
  std::string model{};                 ///< the model file, if it is not where it was
  std::vector<std::string> outputs{};  ///< further ones, as model files write them
};

Option recorded_model_option(RecordedRunArguments& arguments);
Option recorded_result_position(RecordedRunArguments& arguments);

struct RecordedRun {
  StateHistory history;
  ModelDescription description;     ///< with the further outputs
  std::size_t added = 0;            ///< outputs
  std::vector<std::string> inputs;  ///< names of all files that were read
};

/// Proves that the model and all its files are those of the run. Notes on the states are said on
/// standard error. Throws InputError.
RecordedRun load_recorded_run(const RecordedRunArguments& arguments);

/// Those the run was made with, in whose formulation its states are.
SimulationDescription recorded_options(const RecordedRun& run);

struct SelectionArguments {
  std::string from{}, to{};
  ExportSelection taken{};  ///< what the options fill directly

  std::vector<Option> table();
  /// Throws InputError.
  ExportSelection selection() const;
};

}  // namespace floatframe
