#pragma once
#include <string>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Nodes that only membranes, panels and rods hold, all of these in one plane or line: nothing
/// resists motions across it. A sentence that names the first; empty if there is none.
std::string flat_nodes(const FeModel& model);

}  // namespace floatframe
