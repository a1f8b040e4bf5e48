#pragma once
// The summary of a run for other programs: JSON, numbers that are not finite
// as null. The words are those of the command line.
#include <string>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// Of a run: what was asked, what it cost, how well the constraints were met, how it ended.
std::string summary_json(const RunSummary& summary);

}  // namespace floatframe
