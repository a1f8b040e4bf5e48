#pragma once
// Whether what was kept of a run or a simulation can be gone on from. It may come from anywhere:
// nothing of it is used before all of it has been checked.
#include <span>
#include <string>

#include "floatframe/simulation/stepped_model.hpp"

namespace floatframe {

bool all_finite(std::span<const double> numbers) noexcept;

/// Empty, or "is damaged: ..."; `own`: the memory that it would replace.
std::string memory_complaint(const SteppedMemory& given, const SteppedMemory& own, double step);

}  // namespace floatframe
