#pragma once
// Summary of a histogram of step times.
#include "floatframe/core/histogram.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

StepTimes step_times(const Histogram& histogram);

}  // namespace floatframe
