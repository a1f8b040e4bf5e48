#pragma once
// Which instants and bodies of a recorded run are exported.
#include <limits>
#include <string>
#include <vector>

#include "floatframe/history/state_history.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ExportSelection {
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double to = std::numeric_limits<double>::infinity();     ///< [s]
  int every = 1;                    ///< of the instants in this range, the first of them included
  std::vector<std::string> bodies;  ///< names; empty: all that were recorded
};

/// Indices of the instants, ascending. Throws InputError if there is none.
std::vector<std::size_t> selected_instants(const StateHistory& history,
                                           const ExportSelection& selection);

/// Indices of the bodies, ascending. Throws InputError for a body that the model does not have, or
/// whose states were not recorded.
std::vector<int> selected_bodies(const StateHistory& history, const Model& model,
                                 const ExportSelection& selection);

}  // namespace floatframe
