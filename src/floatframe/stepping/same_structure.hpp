#pragma once
// Whether two models differ in numbers alone: the same bodies, joints, elements, inputs and outputs
// in the same order, connected in the same way, with as many states. Counts that follow from these
// (coordinates, constraints) are compared where formulations are made.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Why `changed` is of another structure, to be continued after "the changed model": "has the body
/// 'b' in the place of 'a'"; empty: it is of the same one.
std::string structure_complaint(const Model& present, const Model& changed);
/// The same for options that hold for a whole run: the step, the scheme, its tolerances.
std::string option_complaint(const SimulationDescription& present,
                             const SimulationDescription& changed);

}  // namespace floatframe
