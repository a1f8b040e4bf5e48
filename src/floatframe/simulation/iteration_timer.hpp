#pragma once
// Time of one full Newton iteration of the relative formulation: kinematics, inertia terms, forces,
// residual, factorisation and solution. For benchmarks.
#include "floatframe/model/model.hpp"

namespace floatframe {

/// Smallest time of many repetitions at the start of the run [s].
double relative_iteration_seconds(const Model& model, const SimulationDescription& options);

}  // namespace floatframe
