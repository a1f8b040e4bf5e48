#pragma once
// The entry points above the formulations: count, find the equilibrium of, and run a model.
#include <functional>
#include <string>

#include "floatframe/model/description.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/simulation/results.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe {

/// Coordinates and constraints of both formulations, found from the assembled model (rank by SVD).
ModelCounts check(const Model& model);

/// Static equilibrium from the design configuration. Throws RunError naming the cause.
StaticsResult statics(const Model& model);

/// Throws InputError unless the step and the duration make at least one whole step, or the duration
/// is zero.
void check_step(const SimulationDescription& options);

struct RunOptions {
  /// Called about every 1 % of the run with the fraction done (0..1); outside the timed part.
  std::function<void(double)> progress;
  bool record = true;
  /// Keep the state at the end in the result (where a run that fails came to).
  bool keep_state = false;
  /// Keep the energy balance and say where the run leaves the range of the method (with `record`).
  bool watch = true;
};

/// The summary of a run that could not start.
RunSummary failed_summary(const std::string& model, const SimulationDescription& options,
                          const std::string& message);

/// Runs the model with the options given (those of the model file, changed as the user wishes). A
/// step that cannot converge ends the run: the result holds all up to there and summary.status =
/// "failed". Throws RunError when it cannot start.
RunResult run(const Model& model, const SimulationDescription& options,
              const RunOptions& run_options = {});
/// With the options of the model.
inline RunResult run(const Model& model) { return run(model, model.simulation); }

}  // namespace floatframe
