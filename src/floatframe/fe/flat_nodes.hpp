#pragma once
#include <string>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Nodes connected only to membranes, panels and rods that are all in one plane or line: motion
/// across it has no stiffness. A sentence with the first of them; empty if there is none.
std::string flat_nodes(const FeModel& model);

}  // namespace floatframe
