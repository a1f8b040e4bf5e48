#pragma once
// Elements that read the reaction of a joint need a unique one: of loads that constraints carry
// together any part may be in each of them (loops/redundancy.hpp).
#include "floatframe/loops/redundancy.hpp"

namespace floatframe {

/// Throws RunError naming the first element whose load, at the configuration q, is not unique. Only
/// the parts that enter it count: of planar loops the forces across the axes are.
void require_unique_loads(RelativeFormulation& tree, const VecX& q);

}  // namespace floatframe
