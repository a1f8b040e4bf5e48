#pragma once
// Warnings about the range of the method (docs/range.md) after the run that produced them.
#include "floatframe/run/results.hpp"

namespace floatframe {

/// A run that completed with warnings counts as failed; its results are complete.
void make_strict(RunSummary& summary);

}  // namespace floatframe
