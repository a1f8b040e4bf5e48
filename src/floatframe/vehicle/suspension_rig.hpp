#pragma once
// A suspension on a rig: the chassis is held, the tyres are taken off, and the wheel centres are
// moved to prescribed heights; each point is an equilibrium of the model. What is found is the
// kinematics of the suspension with the compliance of its springs, bushings and flexible bodies
// under these heights and the weight of its parts.
//
// With the unit vector n of the wheel axis, to the left in the design configuration, c the wheel
// centre, h its height in the design configuration:
//   steer  = atan2(-n_x, n_y)             road-wheel angle, positive to the left [rad]
//   toe    = -steer left, +steer right    positive: toe-in [rad]
//   camber = -asin(n_z) left, +asin(n_z) right   positive: the top leans outwards [rad]
//   e      = c - h (z - n_z n)/|z - n_z n|       lowest point of a wheel of the radius h [m]
//   track  = e_y left - e_y right                [m]
//   wheel rate = dF_z/dz                  slope of the force that holds the centre [N/m]
// Compliance: the centres stay at their height of the design configuration, all wheels are loaded
// alike, at the contact points c - h z, and what changes is half the difference of both senses of
// the load.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"

namespace floatframe {

enum class RigSweep { travel, roll, steer };
inline constexpr const char* rig_sweep_words[] = {"travel", "roll", "steer"};

struct RigOptions {
  double travel = 0.06;  ///< largest, up and down [m]; in roll: of the left wheels, right opposite
  double angle = 0.35;   ///< largest road-wheel angle by the input [rad]
  int points = 13;       ///< of a sweep, at least 3, odd: the design height is among them
};

struct RigWheel {
  double height = 0.0;      ///< of the centre above that of the design configuration [m]
  double x = 0.0, y = 0.0;  ///< of the centre, from there [m]
  double steer = 0.0, toe = 0.0, camber = 0.0;  ///< [rad]
  double force = 0.0;                           ///< that holds the wheel up [N]
  std::optional<double> rate = {};              ///< over the travel [N/m]; none in a steer sweep
};

struct RigAxle {
  RigWheel left, right;
  double track = 0.0;  ///< [m]
};

struct RigPoint {
  double travel = 0.0;         ///< of the left wheels [m]
  double input = 0.0;          ///< value of the steering input
  std::vector<RigAxle> axles;  ///< in the order of the description
};

/// An axle whose wheels stay as they are, by 1e-9 rad or m, over a sweep: what it does in a steer
/// sweep means nothing.
bool stands_still(const std::vector<RigPoint>& points, std::size_t axle);

/// The points of a sweep. Throws InputError if the section `vehicle` is missing, or its steering in
/// a steer sweep, and for a wheel that is welded to the chassis; RunError, with the travel, where
/// an equilibrium is not found.
std::vector<RigPoint> suspension_sweep(const ModelDescription& description, RigSweep sweep,
                                       const RigOptions& options);

/// Loads of all wheels at their contact points: 1 kN to the left, 1 kN backwards with the wheels
/// held by their brakes on the carriers, 100 N m about z.
enum class RigLoad { lateral, braking, aligning };
inline constexpr const char* rig_load_words[] = {"lateral_force", "brake_force", "aligning_moment"};

/// x, y, steer, toe, camber and track of the axles are the changes by the load [m], [rad].
struct RigCompliance {
  RigLoad load = RigLoad::lateral;
  std::vector<RigAxle> axles;
};

/// One of each load. Throws as `suspension_sweep`.
std::vector<RigCompliance> suspension_compliance(const ModelDescription& description);

struct RigFigures {
  std::vector<std::string> axles;             ///< names
  std::vector<RigPoint> travel, roll, steer;  ///< steer is empty without a steering input
  std::vector<RigCompliance> compliance;
  std::string input_unit;  ///< of the steering input
};

RigFigures suspension_figures(const ModelDescription& description, const RigOptions& options);

}  // namespace floatframe
