#pragma once
// A fingerprint of the data that determine the motion of a model, bit by bit: bodies, joints,
// forces, markers, inputs and outputs; without start values and options of a run.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Equal fingerprints: equal states have the same meaning and lead to equal steps.
std::string model_hash(const Model& model);

}  // namespace floatframe
