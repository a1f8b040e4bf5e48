#pragma once
// What can be said of the linear equations of a file before any of them is solved.
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Equations whose terms cancel (0 = 0) go, with a note. Throws InputError for those that hold one
/// degree of freedom of the part to the ground.
void look_at_equations(FeModel& model);

}  // namespace floatframe
