#pragma once
// The static equilibrium of a model.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/loops/start_report.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct SystemState;

/// With redundant constraints some reactions are not unique: any multiple of self-balancing forces
/// may be added. Then all reactions are those of minimum norm: the sum of the squares of the forces
/// and of the torques divided by the length of the child.
struct StaticsForce {
  std::string name, type;
  double force = 0;   ///< tension positive [N]; torque [N m] for joint springs on revolutes;
                      ///< vertical force of tyres; of a motion along its coordinate, on the child;
                      ///< of a coupling on a factor of 1
  double length = 0;  ///< measure of the element: length, deflection, angle, coordinate
  bool unique = true;
};
struct StaticsJoint {
  std::string name, type;
  Vec3 force = Vec3::Zero();   ///< on the child, world axes [N]
  Vec3 torque = Vec3::Zero();  ///< on the child about the joint point, world axes [N m]
  std::array<bool, 3> unique_force{true, true, true}, unique_torque{true, true, true};
  bool unique() const;
};
struct StaticsBody {
  std::string name;
  Vec3 position = Vec3::Zero();        ///< body-frame origin [m]
  Vec3 roll_pitch_yaw = Vec3::Zero();  ///< relative to the design pose [rad]
  VecX amplitudes;                     ///< modal amplitudes
};
struct StaticsResult {
  int iterations = 0;
  double residual = 0;  ///< largest unbalanced generalised force
  std::vector<StaticsForce> forces;
  std::vector<StaticsJoint> joints;
  std::vector<StaticsBody> bodies;
  std::shared_ptr<SystemState> state;  ///< the equilibrium, at rest
  std::vector<RedundantDirection> redundant;
  std::vector<std::string> notes;  ///< other notes about the equilibrium: it is unstable
};

/// Static equilibrium from the design configuration. Throws RunError naming the cause.
StaticsResult statics(const Model& model);

}  // namespace floatframe
