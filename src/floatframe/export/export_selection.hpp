#pragma once
// Selection of the instants and bodies of a recorded run for export.
#include <limits>
#include <string>
#include <vector>

#include "floatframe/history/state_history.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ExportSelection {
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double to = std::numeric_limits<double>::infinity();     ///< [s]
  int every = 1;                    ///< every n-th instant in this range, from the first
  std::vector<std::string> bodies;  ///< names; empty: all that were recorded
};

/// Indices of the instants, ascending. Throws InputError if the selection is empty.
std::vector<std::size_t> selected_instants(const StateHistory& history,
                                           const ExportSelection& selection);

/// Indices of the bodies, ascending. Throws InputError for a body that is not in the model or was
/// not recorded.
std::vector<int> selected_bodies(const StateHistory& history, const Model& model,
                                 const ExportSelection& selection);

}  // namespace floatframe
