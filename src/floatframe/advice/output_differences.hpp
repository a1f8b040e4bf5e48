#pragma once
// Differences between the outputs of two runs; see OutputDifference.
#include <vector>

#include "floatframe/advice/mode_advice.hpp"

namespace floatframe {

/// Range of each of the first `outputs` outputs of the full model and, from another run of it, the
/// scatter due to the tolerance of the solver.
std::vector<OutputDifference> output_scales(const ResultTable& full, const ResultTable& other,
                                            std::size_t outputs);

/// The outputs present in both tables, the largest difference first.
std::vector<OutputDifference> output_differences(const std::vector<OutputDifference>& scale,
                                                 const ResultTable& full,
                                                 const ResultTable& reduced);

}  // namespace floatframe
