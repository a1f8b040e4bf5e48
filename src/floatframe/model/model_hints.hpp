#pragma once
// Valid but unusual features of a description - units, angles in degrees, a missing key - and the
// bending stiffness of bars: shown by `check`. Hints are never errors.
#include "floatframe/description/hints.hpp"

namespace floatframe {

struct Model;
struct ModelDescription;

/// For a description without errors and the model built from it.
ModelHints model_hints(const ModelDescription& description, const Model& model);

}  // namespace floatframe
