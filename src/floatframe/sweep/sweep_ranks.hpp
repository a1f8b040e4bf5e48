#pragma once
// A parameter study with given workers, distributed over the processes of mpirun: their messages,
// and the effect of a worker's answer on the study.
//
// Messages between processes of mpirun: one word, a blank, the rest.
//   worker -> 0:  hello <study>   the first message; the study as read by this process
//                 want <n>        accepts n more runs
//                 done <line>     a finished run
//                 error <text>    an error that ends the study
//                 interrupted     a signal interrupted this process
//   0 -> worker:  run <number>    run to be executed
//                 stop            end of the study
#include <atomic>
#include <optional>
#include <string>

#include "floatframe/sweep/ranks.hpp"
#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {

/// Runs the study or its remaining runs; see `run_sweep` of sweep.hpp. `ranks` may be null.
SweepReport run_sweep(const SweepOptions& options, SweepWorkers& workers, Ranks* ranks,
                      const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress);

/// Main loop of a process other than 0: works until process 0 ends the study. Without workers it
/// only waits for that.
void serve_sweep(const SweepOptions& options, SweepWorkers* workers, Ranks& ranks,
                 const std::atomic<bool>& stop);

/// Releases the other processes when process 0 ends before `run_sweep`.
void dismiss_ranks(Ranks& ranks);

std::string word_of(const std::string& message);
std::string rest_of(const std::string& message);

/// The line of a run that a worker has answered; none if cancelled. Throws InputError.
std::optional<std::string> line_of(const SweepOptions& options, const SweepWorkers::Answer& answer);

/// Fingerprint of the files of the first run, as read by this process; none if stopped. Throws
/// InputError, RunError.
std::optional<std::string> first_run_files(const SweepOptions& options, SweepWorkers& workers,
                                           const std::atomic<bool>& stop);

}  // namespace floatframe
