#pragma once
// A parameter study with workers that were made before, and spread over the processes of mpirun.
#include "floatframe/sweep/ranks.hpp"
#include "floatframe/sweep/sweep.hpp"

namespace floatframe {

class SweepWorkers;

/// Runs the study or what is left of it; see `run_sweep` of sweep.hpp. `ranks` may be null.
SweepReport run_sweep(const SweepOptions& options, SweepWorkers& workers, Ranks* ranks,
                      const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress);

/// The part of a process other than 0: works until process 0 says that it is over. Without workers
/// it waits for that only.
void serve_sweep(const SweepOptions& options, SweepWorkers* workers, Ranks& ranks,
                 const std::atomic<bool>& stop);

/// Tells the other processes that nothing will come: when process 0 ends before `run_sweep`.
void dismiss_ranks(Ranks& ranks);

}  // namespace floatframe
