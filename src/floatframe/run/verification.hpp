#pragma once
// Estimates the error of a run by two more runs, at half and at a quarter of its step, from the
// differences of their outputs.
#include "floatframe/description/description.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/step_differences.hpp"

namespace floatframe {

struct RunOptions;

/// Makes both runs, after a run with these options that gave `rows` and ended after `duration` [s].
/// Of `options`, `progress` and `stop` are used. Needs memory for the outputs at half the step.
Verification verify_steps(const Model& model, const SimulationDescription& description,
                          double duration, NextRow rows, const RunOptions& options);

}  // namespace floatframe
