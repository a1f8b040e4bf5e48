#pragma once
#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

/// Of the wrench of a part, that on its second marker, which is all that joints report.
WrenchOf<double> wrench_on_b(const ConstraintSet& set, std::size_t part,
                             const VecX& lambda) noexcept;

/// Adds the wrenches of these multipliers to those of the joints, and sets those of elements
/// that hold.
void add_part_wrenches(const ConstraintSet& set, const VecX& lambda, Reactions& reactions) noexcept;

}  // namespace floatframe
