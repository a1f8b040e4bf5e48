#pragma once
// What the processes of a study tell each other, and what a worker's answer means for the study.
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

#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {

std::string word_of(const std::string& message);
std::string rest_of(const std::string& message);

/// The line of a run whose worker has answered; none if it was cancelled. Throws InputError.
std::optional<std::string> line_of(const SweepOptions& options, const SweepWorkers::Answer& answer);

/// Fingerprint of the files of the first run, as this process sees them; none if stopped. Throws
/// InputError, RunError.
std::optional<std::string> first_run_files(const SweepOptions& options, SweepWorkers& workers,
                                           const std::atomic<bool>& stop);

}  // namespace floatframe
