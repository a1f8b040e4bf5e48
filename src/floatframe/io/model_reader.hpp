#pragma once
// Reads a model file (YAML 1.2 subset, `floatframe: 1`) into a ModelDescription. docs/model-file.md is its reference.
#include <string>
#include <vector>

#include "floatframe/model/description.hpp"

namespace floatframe {

/// "name=value" parameter overrides, as the command line's --set gives them.
struct ParameterOverride {
  std::string name, value;
};

/// Throws InputError with every fault found (file:line:column: sentence). `path` may hold subsystem references,
/// which are read relative to its folder.
ModelDescription read_model(const std::string& path, const std::vector<ParameterOverride>& overrides = {});

}  // namespace floatframe
