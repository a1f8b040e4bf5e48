#pragma once
// The completed run that a folder held before: it is set aside when the first row of a new run
// exists, and goes when the new one is complete. A run that cannot start leaves it where it is; one
// that fails, is interrupted or is killed leaves it in the folder `previous`.
#include <string>

namespace floatframe {

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
