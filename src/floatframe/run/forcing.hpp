#pragma once
// Checks whether a step resolves the prescribed functions of time: motions, loads, actuators and
// targets. Only values at the ends of steps affect a run: a sine with a whole number of cycles per
// step vanishes.
#include <span>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/run/range_warning.hpp"
#include "floatframe/stepping/time_corners.hpp"

namespace floatframe {

struct ForcingLimits {
  double phase = 1.0;   ///< of a sine in a step [rad]
  double passed = 0.1;  ///< of a table's range: deviation from the range of a step's two ends
};

/// At most one sentence about sines and one about tables, each about the worst; empty if the step
/// resolves all of them. `located`: steps are divided at corners. The cost is one pass over the
/// entries of the tables.
std::vector<RangeWarning> unresolved_forcing(const Model& model, double step, double begin,
                                             double duration,
                                             std::span<const TimeCorner> located = {},
                                             const ForcingLimits& limits = {});

}  // namespace floatframe
