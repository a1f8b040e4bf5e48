#pragma once
// The previous run in a folder, according to its summary. A completed one is set aside when the
// first row of a new run exists, and removed when the new one is complete. A run that cannot start
// leaves it in place; one that fails, is interrupted or is killed leaves it in the folder
// `previous`.
#include <string>

#include "floatframe/run/results.hpp"

namespace floatframe {

enum class EarlierRun {
  incomplete,  ///< or no run, or no readable summary
  other,       ///< completed, with another model or other options
  completed
};

/// `summary`: the file; `requested`: the run to compare with, with its duration. Model files are
/// compared by content, independent of their paths.
EarlierRun earlier_run(const std::string& summary, const RunSummary& requested);

struct RunPaths;

/// The folder that set_aside moves it to.
std::string previous_folder(const RunPaths& paths);

/// True if the summary marks the run in the folder, whatever run it is, as completed.
bool holds_completed_run(const RunPaths& paths);

/// Moves the results, the states, the report and, last, the summary, so that the next call
/// continues after a kill; for links, moves their targets. Throws OutputError.
void set_aside(const RunPaths& paths);

/// Removes only the files that were set aside. Never throws.
void remove_set_aside(const RunPaths& paths) noexcept;

}  // namespace floatframe
