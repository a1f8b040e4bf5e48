#pragma once
#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

/// Adds the wrenches of these multipliers to those of the joints, and sets those of elements
/// that hold.
void add_part_wrenches(const ConstraintSet& set, const VecX& lambda, Reactions& reactions) noexcept;

}  // namespace floatframe
