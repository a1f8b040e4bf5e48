#pragma once
// Additional outputs computed from the states of a run: they are sampled at each recorded instant
// as in the run (history/recorded_motion), so that the numbers equal those of a run with these
// outputs. Reactions and their accelerations are solved for.
#include "floatframe/history/state_history.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

/// Time, and the last `added` outputs of the model at every recorded instant. `options`: those of
/// the run. Throws InputError if the states are not of this model or lack data that an output
/// needs, RunError if the model cannot start.
ResultTable new_channels(const StateHistory& history, const Model& model,
                         const SimulationDescription& options, std::size_t added);

/// Throws InputError unless the states are of this model without further outputs, made from the
/// same files by the same build of the library.
void require_model(const StateHistory& history, const Model& model);

}  // namespace floatframe
