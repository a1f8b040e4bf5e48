#pragma once
// What a study is: what must agree before it is continued, and between the processes of mpirun.
#include <map>
#include <string>

#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {

/// What all processes must agree upon before they work together; `first_run`: the fingerprint of
/// the files that the first run reads.
std::string study_hash(const SweepOptions& options, const std::string& first_run);

SweepIdentity identity_of(const SweepOptions& options);

/// Names relative to the model file: a folder may be moved or reached by another path.
std::map<std::string, std::string> relative_to_model(
    const SweepOptions& options, const std::map<std::string, std::string>& files);

}  // namespace floatframe
