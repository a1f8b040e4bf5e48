#pragma once
// The built system: immutable, shared by threads; names first, indices after.
#include "floatframe/model/description.hpp"

namespace floatframe {

struct Model;

/// Checks and builds; throws InputError with every fault.
Model build_model(const ModelDescription& description);

}  // namespace floatframe
