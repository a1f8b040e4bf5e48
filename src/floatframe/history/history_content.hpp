#pragma once
// What the result file of a run says before its rows: the header and the arrays of a model.
#include "floatframe/history/states_file.hpp"
#include "floatframe/simulation/state_layout.hpp"

namespace floatframe {

/// Of a run of the model with these options, whose rows are laid out so.
HistoryContent history_content(const Model& model, const SimulationDescription& options,
                               const StateLayout& layout, HistoryOrigin origin);

/// The name of each mode: of its own, or "mode 3".
std::vector<std::string> names_of_modes(const FlexibleBody& body);
/// Of each mode alone, with the body frame held [Hz]; not finite without mass.
std::vector<double> own_frequencies(const FlexibleBody& body);

}  // namespace floatframe
