#pragma once
// A rotor: the bodies that hang on a joint which leaves a rotation about one axis, and what a turn
// about that axis makes of the modes of a body that is symmetric about it.
//
// Where the shape X y of such a body is turned by theta about its axis e, it is X D y, with
// D = exp(theta G). G is skew with respect to the mass of the modes and commutes with mass and
// stiffness: it acts within modes of equal frequency. What points on the axis and the whole body
// see of a mode, x (displacement and tilt of axis points, int X dm, int r x X dm), must turn with
// it, e x x = x G, which gives G by least squares. Modes that the axis does not see at all (rings
// that become oval) have G = 0: they stay described in turning axes.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/formulation/relative.hpp"

namespace floatframe {

struct RotorBody {
  int body = -1;
  Vec3 axis = Vec3::UnitZ();  ///< in body axes, in the sense of positive speed
  Vec3 p_BP = Vec3::Zero();   ///< a point on the axis, body frame [m]
  MatX G;                     ///< nm x nm
  std::vector<int> on_axis;   ///< nodes, of a flexible body
};

struct Rotor {
  int joint = -1;      ///< of the model
  std::string name;    ///< of the joint
  int body = -1;       ///< that hangs on it
  int coordinate = 0;  ///< velocity of the angle; of a free joint the first of the three rotations
  bool free = false;
  Vec3 axis_F = Vec3::UnitZ();  ///< of a free joint, in its frame F
  std::string other_axis;       ///< other_axis_of_bearings (rotor_symmetry.hpp)
  double sign = 1.0;            ///< of the velocity of the coordinate at positive speed
  bool driven = false;          ///< by a prescribed motion
  Vec3 e_1 = Vec3::UnitX();     ///< across the axis: x of the joint, of a free one the axis after
                                ///< its own in the order x, y, z; world axes
  double length = 1.0;          ///< what tilts are made lengths with [m]
  std::vector<RotorBody> bodies;
};

/// The bodies that hang on the joint `name`: revolute, cylindrical, or free with the axis given (in
/// the joint's axes, through its place on the rotor), or found (rotor_symmetry.hpp). Throws
/// InputError for another joint, if bodies of the rotor move against each other by joints, or if it
/// is not clear about which axis it turns.
Rotor find_rotor(RelativeFormulation& f, const std::string& name, const std::optional<Vec3>& axis);

/// The bodies of the rotor that hangs on a joint, whatever its axis.
std::vector<int> rotor_bodies(const Model& model, const std::string& joint);

/// G of a body with this axis through p_BP, from its nodes on the axis.
MatX turning_of_modes(const FlexibleBody& body, const Vec3& axis, const Vec3& p_BP,
                      const std::vector<int>& on_axis);

/// exp(angle G).
MatX turned_modes(const MatX& G, double angle);

}  // namespace floatframe
