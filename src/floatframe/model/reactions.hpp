#pragma once
// Reactions of joints, elements and motors at a sample (computed by
// reactions/reaction_solver.hpp).
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct Reactions {
  /// World axes; the torque is about the point described at the member.
  struct Wrench {
    Vec3 force = Vec3::Zero();   ///< [N]
    Vec3 torque = Vec3::Zero();  ///< [N m]
  };
  /// Of each joint, its motion and couplings included: on the child, about M.
  std::vector<Wrench> joints;
  /// Of each element with constraints: on the body of its second marker, about that.
  std::vector<Wrench> elements;
  /// Of each element with constraints: the tension of a rod [N], the force or torque of a motion
  /// along the coordinate, on the child, that of a coupling on a factor of 1, the size of that of a
  /// constraint of several rows [N, N m]; zero for others.
  std::vector<double> forces;
  /// For each joint and element, in the velocity projection of the last step: on the child, on the
  /// body at `to` [N s].
  std::vector<Vec3> joint_impulses, element_impulses;
};

}  // namespace floatframe
