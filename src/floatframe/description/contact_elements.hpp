#pragma once
// The structs of elements that touch, stop and rub.
#include <optional>
#include <string>

#include "floatframe/description/attachment.hpp"
#include "floatframe/description/force_function.hpp"

namespace floatframe {

/// Friction on a coordinate of a joint: bristles with the deflection z and a normal force N as a
/// factor: F = N radius (stiffness z + damping zdot) + viscous qdot, against the motion. Sliding at
/// a constant speed it is N radius (kinetic + (breakaway - kinetic) exp(-(qdot / stribeck)^2)) +
/// viscous qdot. N = normal + preload, never below 0; 1 without both. With `reaction` N radius is
/// the sum of N radius, without both 0, and of the forces that the bearing of the joint carries, of
/// an angle times their radii.
struct BristleFriction {
  std::string joint;
  int coordinate = -1;            ///< its number from 0; -1: the only one
  double breakaway = 0.0;         ///< [N] or [N m], per unit of N
  std::optional<double> kinetic;  ///< the same while it slides; absent: equal to breakaway
  double stribeck = 0.0;          ///< [m/s] or [rad/s]; 0: kinetic at any speed
  double stiffness = 0.0;         ///< [N/m] or [N m/rad], per unit of N
  double damping = 0.0;           ///< [N s/m] or [N m s/rad], per unit of N
  double viscous = 0.0;           ///< [N s/m] or [N m s/rad]
  double elastic = 0.95;  ///< of the largest deflection, up to which the bristles do not slide
  std::optional<SignalDescription> normal;  ///< absent: 0
  std::optional<double> preload;            ///< a part of N, not negative [N]; absent: 0
  double radius = 1.0;                      ///< of the faces of a brake or clutch [m]
  bool reaction = false;                    ///< the reaction of the joint is a part of N
  std::optional<double> bearing_radius;     ///< of the pin, across the axis [m]; absent: 0
  std::optional<double> axial_radius;       ///< of the shoulder or the thread [m]; absent: 0
  std::optional<double> bearing_length;     ///< that carries moments [m]; absent: none does
};

/// Pushes two points apart that are closer than `length`, with the compression d = length - s:
/// F = -stiffness d^exponent (1 + b ddot), not tensile. b from the restitution: of two bodies that
/// meet at the speed v they part with restitution x v.
struct UnilateralSpring {
  AttachmentDescription a, b;
  double length = 0.0;     ///< [m]
  double stiffness = 0.0;  ///< [N/m^exponent]
  double exponent = 1.0;
  double restitution = 1.0;   ///< in (0, 1]
  double least_speed = 0.01;  ///< slower contacts are damped as one at this speed [m/s]
};

/// Stops of a coordinate q of a joint: contacts below `lower` and above `upper`, with the
/// compression d = lower - q or q - upper and the law of a UnilateralSpring.
struct JointStop {
  std::string joint;
  int coordinate = -1;                 ///< its number from 0; -1: the only one
  std::optional<double> lower, upper;  ///< at least one of them [m] or [rad]
  double stiffness = 0.0;              ///< [N/m^exponent] or [N m/rad^exponent]
  double exponent = 1.0;
  double restitution = 1.0;   ///< in (0, 1]
  double least_speed = 0.01;  ///< slower contacts are damped as one at this speed [m/s] or [rad/s]
};

/// A shaft (`to`) in a bush (`from`), which carries the axis, with a clearance: beyond it the push
/// of a UnilateralSpring on the eccentricity, with the friction of bristles on the surface.
struct JournalBearing {
  AttachmentDescription from, to;
  Vec3 axis = Vec3::UnitZ();
  double radius = 0.0;     ///< of the shaft [m]
  double clearance = 0.0;  ///< radius of the bush less that of the shaft [m]
  double stiffness = 0.0;  ///< [N/m^exponent]
  double exponent = 1.0;
  double restitution = 1.0;        ///< in (0, 1]
  double least_speed = 0.01;       ///< slower contacts are damped as one at this speed [m/s]
  std::optional<double> friction;  ///< coefficient at which it begins to slide; absent: none
  std::optional<double> kinetic;   ///< the same while it slides; absent: equal to friction
  double stribeck = 0.0;           ///< [m/s]; 0: kinetic at any speed
  double deflection = 1e-5;        ///< of the bristles at `friction` [m]
  double bristle_damping = 0.0;    ///< of the bristles per normal force [s/m]
  double elastic = 0.95;  ///< of the largest deflection, up to which the bristles do not slide
};

}  // namespace floatframe
