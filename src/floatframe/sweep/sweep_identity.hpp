#pragma once
// What a study is: what must agree before it is continued, and between the processes of mpirun.
#include <string>

#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {

/// Which build of the program this is, as results of two builds may differ in rounding: version,
/// build and the fingerprint of the library's file.
std::string program_identity();

/// What all processes must agree upon before they work together; `first_run`: the fingerprint of
/// the files that the first run reads.
std::string study_hash(const SweepOptions& options, const std::string& first_run);

SweepIdentity identity_of(const SweepOptions& options);

}  // namespace floatframe
