#pragma once
// Reactions of joints, rods and motors at a sample (computed by simulation/reaction_solver.hpp).
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct Reactions {
  /// World axes; the torque is about the point described at the member.
  struct Wrench {
    Vec3 force = Vec3::Zero();   ///< [N]
    Vec3 torque = Vec3::Zero();  ///< [N m]
  };
  std::vector<Wrench> joints;    ///< of each joint, its motion included: on the child, about M
  std::vector<Wrench> rods;      ///< of each rod: on the body at `to`, about its end there
  std::vector<double> tensions;  ///< of each rod [N]
  /// For each joint: the force or torque of its prescribed motion along the coordinate, on the
  /// child [N, N m]; zero without one.
  std::vector<double> motions;
  /// For each joint and rod, in the velocity projection of the last step: on the child, on the body
  /// at `to` [N s].
  std::vector<Vec3> joint_impulses, rod_impulses;
};

}  // namespace floatframe
