#pragma once
// The state of a model at one instant, by the names of its joints and bodies and independent of the
// formulation: a run in either formulation can start from it.
//
// A start uses the coordinates and velocities of joints in the form of `JointDescription` (turns
// counted), modal amplitudes and their rates, the time. Poses and velocities of bodies follow from
// them; they are included for reading, and to detect a model that differs from that of the state.
// Accelerations and constraint forces are computed again at a start.
#include "floatframe/description/description.hpp"

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
  /// States and kept numbers of elements, in the order of the model; only of those that have some.
  struct Element {
    std::string name;
    VecX states;
  };
  std::vector<Element> elements;
};

}  // namespace floatframe
