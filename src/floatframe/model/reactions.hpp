#pragma once
// Reactions of joints, elements and motors at a sample (computed by
// simulation/reaction_solver.hpp).
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct Reactions {
  /// World axes; the torque is about the point described at the member.
  struct Wrench {
    Vec3 force = Vec3::Zero();   ///< [N]
    Vec3 torque = Vec3::Zero();  ///< [N m]
  };
  std::vector<Wrench> joints;  ///< of each joint, its motion included: on the child, about M
  /// Of each element with constraints: on the body of its second marker, about that.
  std::vector<Wrench> elements;
  std::vector<double> multipliers;  ///< of each element, its first one: the tension of a rod [N]
  /// For each joint: the force or torque of its prescribed motion along the coordinate, on the
  /// child [N, N m]; zero without one.
  std::vector<double> motions;
  /// For each joint and element, in the velocity projection of the last step: on the child, on the
  /// body at `to` [N s].
  std::vector<Vec3> joint_impulses, element_impulses;
};

}  // namespace floatframe
