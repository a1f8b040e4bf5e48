#pragma once
// The options of a run that have a name and a single value: those of the group `simulation` of a
// model file, set by a study or the command line.
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// coordinates, inertia, start, step, duration, ...
const std::vector<std::string>& simulation_option_names();

/// Sets one option. Returns empty on success, otherwise the error: "found 'x', expected ...".
/// `name` must be one of the names above.
std::string set_simulation_option(SimulationDescription& simulation, const std::string& name,
                                  const std::string& value);

/// The error of the options as a whole, empty if they are valid.
std::string simulation_error(const SimulationDescription& simulation);

}  // namespace floatframe
