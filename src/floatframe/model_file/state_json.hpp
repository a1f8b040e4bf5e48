#pragma once
// States of a model as JSON files, with enough digits to reproduce the same numbers.
#include <string>

#include "floatframe/description/system_state.hpp"

namespace floatframe {

std::string state_json(const SystemState& state);

/// Throws InputError with one sentence if the file is damaged or is not a state file.
SystemState read_state(const std::string& path);

}  // namespace floatframe
