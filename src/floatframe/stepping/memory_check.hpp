#pragma once
// Checks whether a run or a simulation can be continued from stored data. The data may come from
// any source: nothing is used before everything has been checked.
#include <span>
#include <string>

#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

bool all_finite(std::span<const double> numbers) noexcept;

/// Empty, or "is damaged: ..."; `own`: the memory of this formulation that it would replace.
std::string memory_complaint(const StepperMemory& given, const StepperMemory& own,
                             const Formulation& f, double step);

}  // namespace floatframe
