#pragma once
// Identity of a study: must be equal to continue it, and between the processes of mpirun.
#include <string>

#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {

/// Build of the program, as results of two builds may differ in rounding: version, build and the
/// fingerprint of the library's file.
std::string program_identity();

/// Must be equal in all processes before they work together; `first_run`: the fingerprint of the
/// files that the first run reads.
std::string study_hash(const SweepOptions& options, const std::string& first_run);

SweepIdentity identity_of(const SweepOptions& options);

}  // namespace floatframe
