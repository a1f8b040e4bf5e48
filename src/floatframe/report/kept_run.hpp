#pragma once
// A run with all that its files hold, kept in memory until someone wants them: what `floatframe
// run` writes on its way.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model/model_source.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

struct KeptRun {
  RunResult result;
  SimulationDescription options;
  std::string model_file;             ///< for the report; empty if there is none
  std::vector<std::string> settings;  ///< of parameters, "name=value"
  ModelSource source;                 ///< of `model_file`; empty if it is not known
  struct States;
  std::shared_ptr<const States> states;  ///< null: the run kept none
};

/// As `run`, with the states of the run as `record` of its description says (where that leaves it
/// to the command, they are kept). `run_options.rows` and `.states` are its own.
KeptRun run_and_keep(const Model& model, const SimulationDescription& options,
                     const RunOptions& run_options = {});

/// results.csv, states.ffr, report.html and summary.json in a folder, which is made if need be.
/// What is there of an earlier run is replaced. Throws InputError if another process fills the
/// folder, OutputError if a file cannot be written.
void save_run(const Model& model, const KeptRun& run, const std::string& folder);

}  // namespace floatframe
