#pragma once
// The summary of a run for other programs: JSON, with null for numbers that are not finite. The
// terms are those of the command line.
#include <string>

#include "floatframe/run/results.hpp"

namespace floatframe {

/// Summary of a run: options, cost, constraint violations, status at the end.
std::string summary_json(const RunSummary& summary);

}  // namespace floatframe
