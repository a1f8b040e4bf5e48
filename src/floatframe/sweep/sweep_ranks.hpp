#pragma once
// A parameter study with workers that were made before, and spread over the processes of mpirun:
// what these tell each other, and what a worker's answer means for the study.
//
// Messages between processes of mpirun: one word, a blank, the rest.
//   worker -> 0:  hello <study>   the first message; the study as this process understood it
//                 want <n>        may be sent n more runs
//                 done <line>     a finished run
//                 error <text>    something that ends the study
//                 interrupted     a signal asked this process to end
//   0 -> worker:  run <number>    to be done
//                 stop            it is over
#include <atomic>
#include <optional>
#include <string>

#include "floatframe/sweep/ranks.hpp"
#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {

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

std::string word_of(const std::string& message);
std::string rest_of(const std::string& message);

/// The line of a run whose worker has answered; none if it was cancelled. Throws InputError.
std::optional<std::string> line_of(const SweepOptions& options, const SweepWorkers::Answer& answer);

/// Fingerprint of the files of the first run, as this process sees them; none if stopped. Throws
/// InputError, RunError.
std::optional<std::string> first_run_files(const SweepOptions& options, SweepWorkers& workers,
                                           const std::atomic<bool>& stop);

}  // namespace floatframe
