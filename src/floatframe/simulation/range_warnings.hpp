#pragma once
// Warnings about the range of the method (docs/range.md) after the run that gave them.
#include <string>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// Equal for sentences about the same limit; the sentence itself if it is about none.
std::string warning_kind(const std::string& sentence);

/// A run that completed with warnings counts as failed; its results are complete.
void make_strict(RunSummary& summary);

}  // namespace floatframe
