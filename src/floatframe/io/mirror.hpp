#pragma once
// Placement of a subsystem: x' = P x + t, a shift followed by reflections at planes normal to the
// axes; P is diagonal with entries +1 and -1. Rules for a mirrored description (det = det(P)):
//   points                                        P p + t
//   polar vectors (forces, prismatic and guided axes, translations)      P a
//   axial vectors (revolute and universal axes, torques, rotation vectors)   det P a
// so that the same joint coordinate means the mirrored motion. A cylindrical joint has one axis for
// both: the axis is polar and the sign of its angle changes with det. Body frames turn as R' = P R
// P; a rigid body's data change to p_BC' = P p_BC, J' = P J P; a flexible body keeps its
// description and gets `mirror` = P, its modes are mirrored and its modal amplitudes stay equal.
#include "floatframe/model/description.hpp"

namespace floatframe {

struct Placement {
  Mat3 P = Mat3::Identity();
  Vec3 t = Vec3::Zero();
  double det() const { return P(0, 0) * P(1, 1) * P(2, 2); }
  bool identity() const { return P == Mat3::Identity() && t.isZero(0.0); }
  Vec3 point(const Vec3& p) const { return P * p + t; }
  Vec3 polar(const Vec3& a) const { return P * a; }
  Vec3 axial(const Vec3& a) const { return det() * (P * a); }
};

/// First `inner`, then `outer`.
Placement operator*(const Placement& outer, const Placement& inner);
/// Reflection at the plane x[axis] = at.
Placement reflection(int axis, double at);
Placement translation(const Vec3& shift);

void place(AttachmentDescription& a, const Placement& x);
void place(BodyDescription& b, const Placement& x);
void place(JointDescription& j, const Placement& x);
void place(RodDescription& r, const Placement& x);
void place(ForceDescription& f, const Placement& x);
void place(OutputDescription& o, const Placement& x);

}  // namespace floatframe
