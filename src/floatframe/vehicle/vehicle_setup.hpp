#pragma once
// A model made ready for manoeuvres: the roles it needs, what is measured on it, and how it starts.
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"
#include "floatframe/vehicle/circle_figures.hpp"

namespace floatframe {

/// Names of the measured outputs, in the order in which `measured_outputs` adds them; all are of
/// the chassis, the first ones of the driver's point, in world axes.
enum class Measured {
  x,
  y,
  z,  ///< position [m]
  vx,
  vy,
  vz,  ///< [m/s]
  ax,
  ay,
  az,  ///< [m/s2]
  roll,
  pitch,
  yaw,      ///< of ISO 8855, full turns counted [rad]
  yaw_rate  ///< about the world's z [rad/s]
};
inline constexpr const char* measured_names[] = {
    "vehicle.x",     "vehicle.y",   "vehicle.z",       "vehicle.vx", "vehicle.vy",
    "vehicle.vz",    "vehicle.ax",  "vehicle.ay",      "vehicle.az", "vehicle.roll",
    "vehicle.pitch", "vehicle.yaw", "vehicle.yaw_rate"};

/// What a manoeuvre needs of the section `vehicle`.
struct VehicleNeeds {
  bool steering = false, drive = false, brake = false, width = false;
  bool patches = false;  ///< may do with a road whose friction differs from place to place
};

struct VehicleSetup {
  /// With the outputs of `measured_names`, the load of each tyre as "vehicle.AXLE.left.load", and a
  /// start in which the vehicle moves along x and its wheels roll without slip.
  ModelDescription description;
  AxleDistances axles;        ///< of the first and the last one from the driver's point
  double wheel_radius = 0.0;  ///< mean height of the wheel centres in the design configuration [m]
};

/// Throws InputError with a sentence for each thing that the manoeuvre lacks: the section, or a key
/// of it, two axles, a flat road, and for a start that is given as a state. `speed` of the start
/// [m/s].
VehicleSetup vehicle_setup(ModelDescription description, const std::string& manoeuvre,
                           const VehicleNeeds& needs, double speed);

/// Centre of mass of a body in the design configuration; of a flexible one its origin [m].
Vec3 design_centre(const BodyDescription& body);

}  // namespace floatframe
