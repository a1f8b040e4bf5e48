#pragma once
// What the summary in a folder says of the run that was there last.
#include <string>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

enum class EarlierRun {
  incomplete,  ///< or none, or no summary that can be read
  other,       ///< completed, of another model or with other options
  completed
};

/// `summary`: the file; `asked`: of the run that is compared, with its duration. Files of the model
/// count by their content, wherever they lie.
EarlierRun earlier_run(const std::string& summary, const RunSummary& asked);

}  // namespace floatframe
