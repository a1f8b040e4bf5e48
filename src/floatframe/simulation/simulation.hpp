#pragma once
// The entry points above the formulations: count, find the equilibrium of, and run a model.
#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/model/description.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/simulation/results.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe {

struct StateLayout;

/// Coordinates and constraints of both formulations, found from the assembled model (rank by SVD).
ModelCounts check(const Model& model);

/// Static equilibrium from the design configuration. Throws RunError naming the cause.
StaticsResult statics(const Model& model);

/// Throws InputError unless the step and the duration make at least one whole step, or the duration
/// is zero.
void check_step(const SimulationDescription& options);

/// All that decides how a run goes on from a step, and what its summary says of the steps before:
/// the rest of the run and its summary are those of a run that was not interrupted, to the bit. It
/// belongs to one model and one set of options, and to the copy of the library it was made with.
struct RunCheckpoint {
  double time = 0.0;  ///< [s]
  std::vector<std::byte> bytes;
};

struct RunOptions {
  /// Called about every 1 % of the run with the fraction done (0..1); outside the timed part.
  std::function<void(double)> progress;
  bool record = true;
  /// Keep the state at the end in the result (where a run that fails came to).
  bool keep_state = false;
  /// Keep the energy balance and say where the run leaves the range of the method (with `record`).
  bool watch = true;
  /// Takes the rows as they are recorded, in blocks: after the step that ends half a second after
  /// the last block, when a block is full, and at the end. The table of the result has no rows
  /// then, and the memory of a run does not depend on its length. At the start of a run that is
  /// resumed it is called without numbers. An OutputError that it throws ends the run, which fails.
  std::function<void(const std::vector<Column>&, std::span<const double>)> rows;
  /// Takes the states of the run, as `record` of its description says which: blocks of whole rows,
  /// as `rows` (only where rows are recorded), handed over after these. At the start of a run
  /// that is resumed it is called without numbers.
  std::function<void(const StateLayout&, std::span<const double>)> states;
  /// Looked at between steps: true ends the run, whose status is "interrupted".
  const std::atomic<bool>* stop = nullptr;
  /// Called every so many seconds of simulated time [s], and when the run is interrupted, after all
  /// rows up to there were handed over. What it throws is taken as from `rows`.
  double checkpoint_every = 0.0;
  std::function<void(const RunCheckpoint&)> checkpoint;
  /// Goes on from there. The run throws InputError if it is of another model or other options.
  const RunCheckpoint* resume = nullptr;
};

/// What a summary says of a run before its first step.
RunSummary asked_summary(const std::string& model, const SimulationDescription& options);
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
