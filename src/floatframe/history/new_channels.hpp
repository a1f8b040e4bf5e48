#pragma once
// Outputs that a run did not have, from its states: at each recorded instant they are sampled as
// the run samples them (history/recorded_motion), so the numbers are those of a run that had the
// outputs from the start. Reactions and the accelerations with them are solved for.
#include "floatframe/history/state_history.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/simulation/result_table.hpp"

namespace floatframe {

/// Time, and the last `added` outputs of the model at every recorded instant. `options`: those of
/// the run. Throws InputError if the states are not of this model or do not hold what an output
/// needs, RunError if the model cannot start.
ResultTable new_channels(const StateHistory& history, const Model& model,
                         const SimulationDescription& options, std::size_t added);

/// Throws InputError unless the states are of this model, which has no further outputs: it was made
/// from the same files by the same copy of the library.
void require_model(const StateHistory& history, const Model& model);

}  // namespace floatframe
