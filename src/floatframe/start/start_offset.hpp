#pragma once
// Bodies moved away from where a run would start.
#include <map>
#include <string>

#include "floatframe/description/description.hpp"
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

/// Moves the named bodies, by the least change of the rigid coordinates that keeps loops closed, at
/// time t. A body keeps its orientation if its joints allow it. Throws InputError for an unknown
/// body, RunError if the joints prevent a body from moving there.
void apply_offsets(RelativeFormulation& f, const std::map<std::string, StartOffset>& offsets,
                   double t, VecX& q);

}  // namespace floatframe
