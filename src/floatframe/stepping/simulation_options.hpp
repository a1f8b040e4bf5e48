#pragma once
// The options of a simulation as a description.
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

/// The options of the model with the given replacements. Throws InputError if they are not valid.
SimulationDescription described(const Model& model, const SimulationOptions& options);

}  // namespace floatframe
