#pragma once
// The mirror image of a flexible body: body coordinates p -> P p with P = diag(+-1). Translations
// of modes transform as vectors, rotations as axial vectors (det(P) P); stiffness, damping and
// frequencies are unchanged. Exact: only signs change.
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// P must be diagonal with entries +1 or -1; InputError otherwise.
FlexibleBody mirrored(const FlexibleBody& body, const Mat3& P);
BodyShape mirrored(const BodyShape& shape, const Mat3& P);

}  // namespace floatframe
