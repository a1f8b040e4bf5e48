#pragma once
// What `floatframe pack` and `floatframe fmu` make of a model file.
#include <string>
#include <vector>

#include "floatframe/apps/command.hpp"
#include "floatframe/packed/pack.hpp"

namespace floatframe {

/// With the settings of the command line. `outputs`: names with commas between them; empty: all.
/// `fixed` receives a sentence about each parameter that cannot change. Throws InputError.
PackedModel packed_of(const ModelArguments& model, const std::string& outputs,
                      PackOptions::Contents contents, std::vector<std::string>& fixed);

}  // namespace floatframe
