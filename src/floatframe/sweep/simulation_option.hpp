#pragma once
// The options of a run that have a name and one value: those of the group `simulation` of a model
// file, set from outside.
#include <string>
#include <vector>

#include "floatframe/model/description.hpp"

namespace floatframe {

/// coordinates, inertia, start, step, duration, ...
const std::vector<std::string>& simulation_option_names();

/// Sets one option. Empty if done, otherwise what is wrong: "found 'x', expected ...". `name` must
/// be one of the names above.
std::string set_simulation_option(SimulationDescription& simulation, const std::string& name,
                                  const std::string& value);

/// What is wrong with the options together, empty if nothing.
std::string simulation_error(const SimulationDescription& simulation);

}  // namespace floatframe
