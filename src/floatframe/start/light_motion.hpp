#pragma once
// Explains the failure of a run that began with regular masses: a coordinate has lost its mass
// during the run (a bar without spin inertia whose joint axis becomes parallel to it, a body held
// by forces only). Its speed is then unbounded, or its position jumps, and no step is small enough.
#include <string>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"

namespace floatframe {

/// A basis (columns) of the motions that the constraints J leave free.
MatX free_motions(const MatX& J, const VecX& possible);

/// Addition to the failure message of a run at this state, beginning with "; ", or nothing.
std::string light_motion_note(Formulation& f, const State& state);

}  // namespace floatframe
