#pragma once
// The part of a result file before its rows: the header and the arrays of a model.
#include "floatframe/history/states_file.hpp"
#include "floatframe/run/state_layout.hpp"

namespace floatframe {

/// For a run of the model with these options and this layout of rows.
HistoryContent history_content(const Model& model, const SimulationDescription& options,
                               const StateLayout& layout, HistoryOrigin origin);

/// The name of each mode, or "mode 3".
std::vector<std::string> names_of_modes(const FlexibleBody& body);
/// Frequency of each mode alone, with the body frame fixed [Hz]; not finite without mass.
std::vector<double> own_frequencies(const FlexibleBody& body);

}  // namespace floatframe
