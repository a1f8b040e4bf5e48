#pragma once
// The commands that are made of the list of analyses.
#include <vector>

#include "floatframe/apps/command.hpp"

namespace floatframe {

/// One for each, in the order of analyses/analysis_list.hpp.
std::vector<Command> analysis_commands();

}  // namespace floatframe
