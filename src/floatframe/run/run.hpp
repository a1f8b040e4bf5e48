#pragma once
// Runs of a model, independent of the formulation.
#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

struct StateLayout;

/// Throws InputError unless the step and the duration give at least one whole step, or the duration
/// is zero.
void check_step(const SimulationDescription& options);

/// The distance of rows in steps.
long steps_per_row(const SimulationDescription& options) noexcept;

/// Complete state of an interrupted run: the rest of the run and its summary are those of an
/// uninterrupted run, bit for bit. It is valid for one model, one set of options, and the build of
/// the library that made it.
struct RunCheckpoint {
  double time = 0.0;  ///< [s]
  std::vector<std::byte> bytes;
};

struct RunOptions {
  /// Called about every 1 % of the run with the fraction done (0..1); outside the timed part.
  std::function<void(double)> progress;
  bool record = true;
  /// Keep the final state in the result (for a failed run, the last state reached).
  bool keep_state = false;
  /// Monitor the energy balance and departures from the range of the method (with `record`).
  bool watch = true;
  /// Receives the rows as they are recorded, in blocks: after the first step that ends half a
  /// second after the last block, when a block is full, and at the end. The table of the result has
  /// no rows then, and memory does not depend on the length of the run. At the start of a resumed
  /// run it is called without numbers. An OutputError that it throws ends the run, which fails.
  std::function<void(const std::vector<Column>&, std::span<const double>)> rows;
  /// Receives the states of the run, as selected by `record` of its description: blocks of whole
  /// rows, like `rows` (only where rows are recorded), after these. At the start of a resumed run
  /// it is called without numbers.
  std::function<void(const StateLayout&, std::span<const double>)> states;
  /// Checked between steps: true ends the run with the status "interrupted".
  const std::atomic<bool>* stop = nullptr;
  /// Called at this interval of simulated time [s], and when the run is interrupted, after all rows
  /// up to there were handed over. Its exceptions are treated like those of `rows`.
  double checkpoint_every = 0.0;
  std::function<void(const RunCheckpoint&)> checkpoint;
  /// Continues from this state. Throws InputError if it is of another model or other options.
  const RunCheckpoint* resume = nullptr;
};

/// "ended at t = 1.25 s, where x - 2 crosses zero", or that it never did; empty without `until`.
std::string until_text(const RunSummary& summary);
/// The contents of a summary before the first step.
RunSummary asked_summary(const std::string& model, const SimulationDescription& options);
/// The summary of a run that could not start.
RunSummary failed_summary(const std::string& model, const SimulationDescription& options,
                          const std::string& message);

/// Runs the model with the given options (those of the model file, changed by the user). A step
/// that cannot converge ends the run: the result contains everything up to there and summary.status
/// = "failed". Throws RunError if it cannot start.
RunResult run(const Model& model, const SimulationDescription& options,
              const RunOptions& run_options = {});
/// With the options of the model.
inline RunResult run(const Model& model) { return run(model, model.simulation); }

}  // namespace floatframe
