#pragma once
// A fingerprint of what decides the motion of a model, bit by bit: bodies, joints, forces, markers,
// inputs and outputs; not the values it starts from, nor the options of a run.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Equal fingerprints: equal states go on with equal steps and mean the same.
std::string model_hash(const Model& model);

}  // namespace floatframe
