#pragma once
// Transforms entities of a description in a subsystem that is shifted and mirrored
// (description/placement.hpp): points, polar and axial vectors by their kind, joints by their
// JointKind. Body frames become R' = P R P; a rigid body's data become p_BC' = P p_BC, J' = P J P;
// a flexible body keeps its description and gets `mirror` = P, its modes are mirrored and its modal
// amplitudes stay equal.
#include "floatframe/description/description.hpp"
#include "floatframe/description/placement.hpp"

namespace floatframe {

void place(AttachmentDescription& a, const Placement& x);
void place(BodyDescription& b, const Placement& x);
void place(JointDescription& j, const Placement& x);
void place(ElementDescription& f, const Placement& x);
void place(OutputDescription& o, const Placement& x);

}  // namespace floatframe
