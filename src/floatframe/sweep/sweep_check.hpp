#pragma once
// Before the first run: all runs are read and their values checked, in the worker processes.
#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {

struct CheckedRuns {
  bool stopped = false;                     ///< before all was checked
  std::vector<int> worker;                  ///< the worker that checked each run
  std::map<std::size_t, std::string> lost;  ///< runs that have already failed, and the reason
};

/// Checks all runs and builds the model of the first. A run whose reading or building crashes or
/// exceeds a limit is not an input error but a failed run. Throws InputError with the errors of all
/// runs, each once, in the order of the runs; RunError.
CheckedRuns check_runs(const SweepOptions& options, SweepWorkers& workers,
                       const std::atomic<bool>& stop,
                       const std::function<void(const SweepProgress&)>& progress);

}  // namespace floatframe
