#pragma once
// What a model is as a vehicle: the roles of its bodies, tyres and inputs, by name. The motion of
// the model does not depend on it; manoeuvres do (room `vehicle`).
#include <optional>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct VehicleWheel {
  std::string wheel;  ///< body that carries the tyre
  std::string tyre;   ///< force element
  std::string spin;   ///< joint about which it spins; empty: it does not
  Origin origin = {};
};

struct VehicleAxle {
  std::string name;
  VehicleWheel left, right;
  Origin origin;
};

/// An input of the model and what it does: its value is `ratio` times the quantity.
struct VehicleInput {
  std::string input;
  double ratio = 1.0;
  Origin origin;
};

struct VehicleDescription {
  std::string chassis;              ///< body
  std::optional<Vec3> driver = {};  ///< point of the chassis, design configuration [m]; its origin
  std::vector<VehicleAxle> axles = {};        ///< from the front to the rear
  std::optional<VehicleInput> steering = {};  ///< of the road-wheel angle [rad], positive: left
  std::optional<VehicleInput> drive = {};     ///< of the torque of all driven wheels [N m]
  std::optional<VehicleInput> brake = {};     ///< of the brake torque of all wheels [N m]
  double width = 0.0;                         ///< without mirrors [m]; 0: not given
  double front = 0.0, rear = 0.0;             ///< from the driver's point to the ends [m]
  Origin origin = {};
};

}  // namespace floatframe
