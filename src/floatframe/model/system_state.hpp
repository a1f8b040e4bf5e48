#pragma once
// Where a model is at one instant, by the names of its joints and bodies and in no formulation's
// coordinates: a run of either formulation can start from it.
//
// What a start takes: the coordinates and velocities of joints in the form of `JointDescription`
// (turns counted), modal amplitudes and their rates, the time. Poses and velocities of bodies
// follow from them; they are here to be read, and to notice a model that is not the one the state
// was taken of. Accelerations and constraint forces are found anew at a start.
#include "floatframe/model/description.hpp"

namespace floatframe {

struct SystemState {
  struct Joint {
    std::string name;
    JointType type = JointType::free;
    std::vector<double> position, velocity;
  };
  struct Body {
    std::string name;
    Vec3 position = Vec3::Zero();             ///< origin of the body frame, world [m]
    Eigen::Vector4d orientation{1, 0, 0, 0};  ///< quaternion (w, x, y, z), body to world
    Vec3 velocity = Vec3::Zero();             ///< of the origin, world [m/s]
    Vec3 angular_velocity = Vec3::Zero();     ///< world [rad/s]
    VecX amplitudes, amplitude_rates;
  };
  std::string file;   ///< that it was read from, for messages
  std::string model;  ///< name of the model it was taken of
  double time = 0.0;  ///< [s]
  std::vector<Joint> joints;
  std::vector<Body> bodies;
};

}  // namespace floatframe
