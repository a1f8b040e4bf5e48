#pragma once
// The options of a simulation as a description.
#include "floatframe/simulation/stepping.hpp"

namespace floatframe {

/// Those of the model with what is replaced. Throws InputError if they are not valid.
SimulationDescription described(const Model& model, const SimulationOptions& options);

}  // namespace floatframe
