#pragma once
// Reads a model file (YAML 1.2 subset, `floatframe: 1`) into a ModelDescription. docs/model-file.md
// is its reference.
#include <string>
#include <vector>

#include "floatframe/io/model_fingerprint.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

/// "name=value" parameter overrides, as the command line's --set gives them.
struct ParameterOverride {
  std::string name, value;
};

/// Throws InputError with every fault found (file:line:column: sentence). `path` may hold subsystem
/// references, which are read relative to its folder. `used`, if given, is told what was read, as
/// far as the reading came.
ModelDescription read_model(const std::string& path,
                            const std::vector<ParameterOverride>& overrides = {},
                            ModelFingerprint* used = nullptr);

}  // namespace floatframe
