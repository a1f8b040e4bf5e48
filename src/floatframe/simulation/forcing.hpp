#pragma once
// Whether a step resolves what a model prescribes over time: motions, loads, actuators and targets.
// Only values at the ends of steps reach a run: a sine of a whole number of cycles per step is
// none.
#include <span>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/simulation/range_warning.hpp"
#include "floatframe/simulation/time_corners.hpp"

namespace floatframe {

struct ForcingLimits {
  double phase = 1.0;   ///< of a sine in a step [rad]
  double passed = 0.1;  ///< of the range of a table, by which it leaves that of a step's two ends
};

/// At most a sentence about sines and one about tables, about the worst; empty if the step resolves
/// all. `located`: where steps are divided. The time it takes is that of a look at every entry of
/// the tables.
std::vector<RangeWarning> unresolved_forcing(const Model& model, double step, double begin,
                                             double duration,
                                             std::span<const TimeCorner> located = {},
                                             const ForcingLimits& limits = {});

}  // namespace floatframe
