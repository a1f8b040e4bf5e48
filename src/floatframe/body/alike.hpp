#pragma once
// Bodies of equal appearance and deformation, which pictures and files need once: the four wheels
// of a car, links of a chain.
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// The same nodes and surface with the same motions of every mode, bit by bit. Mass and stiffness
/// may differ.
bool look_alike(const FlexibleBody& a, const FlexibleBody& b);

}  // namespace floatframe
