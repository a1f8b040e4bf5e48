#pragma once
// The structs of the elements that couple coordinates of joints: sums of them, and gears, racks,
// screws and belts by name.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/description/force_function.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// A coordinate of a joint, times a factor.
struct CoordinateTerm {
  std::string joint;
  int coordinate = -1;  ///< its number from 0; -1: the only one
  double factor = 1.0;
};

/// Holds a sum of coordinates of joints, displacements along or angles about an axis: sum of factor
/// x coordinate = value. Factors have the units that make the sum one of the first coordinate.
struct Coupling {
  std::vector<CoordinateTerm> terms;
  std::optional<TimeFunction> value;  ///< of time, without jumps; absent: 0
};

/// The flanks that carry: those of a driver that drives in the sense of its joint, or against it.
enum class GearFlank { forward, backward };

/// Two wheels that mesh, or are pressed together, on parallel axes. Wheels are the children of
/// their joints, whose angles are coupled; senses follow from the axes as drawn. Without a pressure
/// angle it exerts torques about the axes; with one the force of the teeth at the pitch point,
/// which divides the line between the joints in the ratio of the pitch circles.
struct Gear {
  CoordinateTerm driver, driven;
  std::optional<double> ratio = {};  ///< turns of the driver per turn of the driven wheel, or ...
  MatX teeth = {};                   ///< ... 1 x 2: of the driver, of the driven wheel
  bool internal = false;             ///< one of them is a ring: both turn in the same sense
  std::optional<double> pressure_angle = {};  ///< in the section normal to the teeth [rad]
  double helix_angle = 0.0;  ///< of the driver on its pitch circle, right-hand positive [rad]
  GearFlank flank = GearFlank::forward;
  /// Elastic teeth, without the force at the pitch point: torque on the driver per angle of it
  /// while the driven wheel is held, and its play.
  std::optional<double> mesh_stiffness = {};  ///< [N m/rad]
  double mesh_damping = 0.0;                  ///< [N m s/rad], while teeth touch
  double backlash = 0.0;                      ///< [rad], both ways together
};

/// Two wheels on axes that cross. It exerts torques about the axes.
struct BevelGear {
  CoordinateTerm driver, driven;
  std::optional<double> ratio = {};  ///< as of a gear, or ...
  MatX teeth = {};                   ///< ... 1 x 2
  bool same_sense = false;           ///< both angles grow together
};

/// Sun, ring and carrier on one axis, with planets whose inertia is neglected:
/// z_sun (sun - carrier) + z_ring (ring - carrier) = 0. One that is absent does not turn.
struct PlanetaryGear {
  std::optional<CoordinateTerm> sun = {}, ring = {}, carrier = {};
  MatX teeth = {};  ///< 1 x 2: of sun and ring
};

/// Two shafts whose mean turns with the cage: left + right = 2 cage.
struct DifferentialGear {
  CoordinateTerm left, right, cage;
};

/// The displacement of the rack is the radius times the angle of the pinion.
struct RackAndPinion {
  CoordinateTerm pinion, rack;
  double radius = 0.0;    ///< of the pitch circle [m]
  bool reversed = false;  ///< the rack moves back while the angle grows
};

/// The displacement of the nut is the lead times the turns: of two joints, or of a joint that has
/// both coordinates.
struct ScrewDrive {
  std::optional<CoordinateTerm> joint = {};                       ///< this, or ...
  std::optional<CoordinateTerm> rotation = {}, translation = {};  ///< ... both of these
  double lead = 0.0;  ///< [m] per turn; negative: the displacement falls while the angle grows
};

/// A belt or chain that does not slip, on two pulleys with parallel axes.
struct BeltDrive {
  CoordinateTerm driver, driven;
  MatX radii = {};       ///< 1 x 2: of the driver, of the driven pulley [m]
  bool crossed = false;  ///< the pulleys turn in opposite senses
  /// Elastic: force along the belt, the difference of both strands, per length that it gives.
  std::optional<double> stiffness = {};  ///< [N/m]
  double damping = 0.0;                  ///< [N s/m]
};

/// A coordinate that follows another one: factor x the other + offset.
struct Mimic {
  CoordinateTerm joint, follows;
  double factor = 1.0;
  double offset = 0.0;  ///< [m] or [rad]
};

}  // namespace floatframe
