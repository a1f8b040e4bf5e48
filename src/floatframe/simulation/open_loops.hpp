#pragma once
// Words for constraints that cannot be closed at the start.
#include <string>

#include "floatframe/formulation/relative.hpp"

namespace floatframe {

/// At the present positions, where constraints have gaps of `residual` [m; rates: m/s] and no
/// change of the coordinates helps: "joint 'd' has a gap of 0.3 m", or that prescribed motions
/// contradict each other or, for rates, the constraints.
std::string open_loops_text(RelativeFormulation& f, const VecX& residual, bool rates);

}  // namespace floatframe
