#pragma once
// The run that a folder held before, and what its summary says of it. One that was completed is set
// aside when the first row of a new run exists, and goes when the new one is complete. A run that
// cannot start leaves it where it is; one that fails, is interrupted or is killed leaves it in the
// folder `previous`.
#include <string>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

enum class EarlierRun {
  incomplete,  ///< or none, or no summary that can be read
  other,       ///< completed, of another model or with other options
  completed
};

/// `summary`: the file; `asked`: of the run that is compared, with its duration. Files of the model
/// count by their content, wherever they lie.
EarlierRun earlier_run(const std::string& summary, const RunSummary& asked);

struct RunPaths;

/// Where it is set aside.
std::string previous_folder(const RunPaths& paths);

/// True if the summary says that the run in the folder is complete, whatever run that is.
bool holds_completed_run(const RunPaths& paths);

/// Moves the results, the states, the report and, last, the summary, so that what a kill interrupts
/// is continued by the next call; of links what they lead to. Throws OutputError.
void set_aside(const RunPaths& paths);

/// Removes what was set aside, and nothing else. Never throws.
void remove_set_aside(const RunPaths& paths) noexcept;

}  // namespace floatframe
