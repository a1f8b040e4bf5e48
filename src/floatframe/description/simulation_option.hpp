#pragma once
// The options of a run that have a name and a single value: those of the group `simulation` of a
// model file, set by a study, the command line or a program in C.
#include <string>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/description.hpp"

namespace floatframe {

/// The numbers of the section `simulation`: a key of the file, or an option of that name.
struct SimulationNumber {
  const char* name;
  double SimulationDescription::*at;
  NumberRule rule;
};
const std::vector<SimulationNumber>& simulation_numbers();

/// coordinates, inertia, start, step, duration, ...
const std::vector<std::string>& simulation_option_names();

/// Sets one option. Returns empty on success, otherwise the error: "found 'x', expected ...".
/// `name` must be one of the names above.
std::string set_simulation_option(SimulationDescription& simulation, const std::string& name,
                                  const std::string& value);

/// The error of the options as a whole, empty if they are valid.
std::string simulation_error(const SimulationDescription& simulation);

}  // namespace floatframe
