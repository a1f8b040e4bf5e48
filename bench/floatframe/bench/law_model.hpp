#pragma once
// Masses on springs whose force is a law F(x, v, t), in C++ or by a formula: what a formula costs.
#include "floatframe/description/description.hpp"

namespace floatframe {

/// 20 masses of 1 kg on rails, F = 100 x + 400 x^3 + v / 2 against each [N, m, m/s].
ModelDescription law_model(bool by_formula);

}  // namespace floatframe
