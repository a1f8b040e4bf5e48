#pragma once
// A flexible body with fewer modes: amplitudes not kept are held at zero. Columns of the mode
// shapes are removed, and rows and columns of the integrals, of stiffness and of damping; nothing
// is recomputed, so the body behaves as if it had been reduced with the modes kept.
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// `keep`: modes from 0, ascending. With none the body is rigid and keeps its nodes.
FlexibleBody with_modes(const FlexibleBody& body, const std::vector<int>& keep);

}  // namespace floatframe
