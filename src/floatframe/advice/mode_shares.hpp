#pragma once
// Participation of the modes of one body in its loads and in a run; see mode_advice.hpp.
#include "floatframe/advice/mode_advice.hpp"

namespace floatframe {

/// `y`: amplitudes of the body in a run, one column for each of `times` [s]; h: the step [s].
BodyAdvice body_advice(const Model& model, int index, const MatX& y, const VecX& times, double h);

}  // namespace floatframe
