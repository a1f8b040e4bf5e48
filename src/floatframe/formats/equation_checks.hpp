#pragma once
// Checks of the linear equations of a file before any of them is solved.
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Removes equations whose terms cancel (0 = 0), with a note. Throws InputError for those that fix
/// one degree of freedom of the part to the ground.
void check_equations(FeModel& model);

}  // namespace floatframe
