#pragma once
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// By node: 1 if no line of the file gives it, but a reader made it for an element, whose line it
/// has: the end of a bar beside its node or with a hinge, the middle of an element.
std::vector<char> made_nodes(const FeModel& model);

}  // namespace floatframe
