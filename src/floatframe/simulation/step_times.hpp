#pragma once
// What a histogram of step times says in a summary.
#include "floatframe/core/histogram.hpp"
#include "floatframe/simulation/results.hpp"

namespace floatframe {

StepTimes step_times(const Histogram& histogram);

}  // namespace floatframe
