#pragma once
// Placement of a subsystem: x' = P x + t, a shift followed by reflections at planes normal to the
// axes; P is diagonal with entries +1 and -1. With det = det(P):
//   points                                                            P p + t
//   polar vectors (forces, translations, axes along which is moved)   P a
//   axial vectors (torques, rotation vectors, axes that are turned about)   det P a
// so that the same number means the mirrored motion.
#include <vector>

#include "floatframe/math/types.hpp"

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

/// For start values, which may be missing: the three starting at `at` as a vector of their kind, or
/// one of them times `sign`.
void place_polar(std::vector<double>& values, std::size_t at, const Placement& x);
void place_axial(std::vector<double>& values, std::size_t at, const Placement& x);
void change_sign(std::vector<double>& values, std::size_t at, double sign);

}  // namespace floatframe
