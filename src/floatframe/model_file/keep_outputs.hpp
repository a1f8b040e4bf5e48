#pragma once
// A choice among the outputs of a model: what a program for others shows of it.
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// Keeps the outputs with these names, in the order of the model, and all of "name.x", "name.y" for
/// a "name". The others that formulas may name become measures. Throws InputError for a name that
/// is none.
void keep_outputs(ModelDescription& description, const std::vector<std::string>& names);

}  // namespace floatframe
