#pragma once
// Inertia terms of one body, by both methods: the terms that a formulation computes in each step,
// for programs that need them directly. Allocates.
//
//   relative   qdot = (sdot, omega, ydot):  M is (6+nm)^2,  Qv = 6+nm
//   absolute   qdot = (r0dot, udot, vdot, wdot, ydot), A = [u v w]:  M is (12+nm)^2,  Qv = 12+nm
// Conventions: docs/theory.md. Both methods give the same result for a body with the mass model
// isoparametric.
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// Position and motion of a body.
struct BodyMotion {
  Vec3 r0 = Vec3::Zero();     ///< origin of the body frame, world [m]
  Mat3 A = Mat3::Identity();  ///< columns: axes of the body in the world
  Vec3 omega = Vec3::Zero();  ///< angular velocity, world [rad/s]
  VecX y, ydot;               ///< modal amplitudes and their rates; empty: zero
  /// Includes `FlexibleBody::second_order`, which the body must have. `FlexibleBody::turning` is
  /// always included.
  bool geometric_stiffening = false;
};

struct InertiaTerms {
  MatX M;   ///< mass matrix
  VecX Qv;  ///< forces that depend on velocities
};

/// From the 16 constant integrals. Throw InputError if sizes are inconsistent.
InertiaTerms relative_preprocessing(const FlexibleBody& body, const BodyMotion& motion);
InertiaTerms absolute_preprocessing(const FlexibleBody& body, const BodyMotion& motion);

/// From the finite-element mass. Throw InputError for a body without ProjectionData, too.
InertiaTerms relative_projection(const FlexibleBody& body, const BodyMotion& motion);
InertiaTerms absolute_projection(const FlexibleBody& body, const BodyMotion& motion);

}  // namespace floatframe
