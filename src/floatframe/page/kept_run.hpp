#pragma once
// A run with the content of all its files, kept in memory until it is saved: `floatframe run`
// writes these files while it runs.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/description/model_source.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/controlled_run.hpp"
#include "floatframe/run/recording.hpp"

namespace floatframe {

struct KeptRun {
  RunResult result;
  SimulationDescription options;
  std::string model_file;             ///< for the report; may be empty
  std::vector<std::string> settings;  ///< of parameters, "name=value"
  ModelSource source;                 ///< of `model_file`; empty if unknown
  struct States;
  std::shared_ptr<const States> states;  ///< null: no states recorded
};

/// As `run`, with the states of the run according to `record` of its description (recorded if it is
/// not given). `run_options.rows` and `.states` are overwritten.
KeptRun run_and_keep(const Model& model, const SimulationDescription& options,
                     const RunOptions& run_options = {}, const Controller& controller = {});

/// What a recording has so far.
KeptRun keep_recording(Recording& recording);

/// results.csv, states.ffr, report.html and summary.json in a folder, which is created if
/// necessary. Files of an earlier run are replaced. Throws InputError if another process writes to
/// the folder, OutputError if a file cannot be written.
void save_run(const Model& model, const KeptRun& run, const std::string& folder);

/// The bytes of the states.ffr that `save_run` writes, for a file in no folder yet; empty if no
/// states were recorded.
std::string states_of_run(const Model& model, const KeptRun& run);

}  // namespace floatframe
