#pragma once
// A rotor: the bodies attached to a joint that allows a rotation about one axis, and the effect of
// a rotation about that axis on the modes of a body that is symmetric about it.
//
// If the shape X y of such a body is rotated by theta about its axis e, it becomes X D y, with D =
// exp(theta G). G is skew with respect to the mass of the modes and commutes with mass and
// stiffness: it acts within modes of equal frequency. The components x of a mode on the axis and of
// the whole body (displacement and tilt of axis points, int X dm, int r x X dm) must rotate with
// it, e x x = x G, which gives G by least squares. Modes without any such component (rings that
// become oval) have G = 0: they remain described in rotating axes.
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
  int body = -1;       ///< attached to it
  int coordinate = 0;  ///< velocity of the angle; of a free joint the first of the three rotations
  bool free = false;
  Vec3 axis_F = Vec3::UnitZ();  ///< of a free joint, in its frame F
  std::string other_axis;       ///< other_axis_of_bearings (rotor_symmetry.hpp)
  double sign = 1.0;            ///< of the velocity of the coordinate at positive speed
  bool driven = false;          ///< by a prescribed motion
  Vec3 e_1 = Vec3::UnitX();     ///< across the axis: x of the joint, of a free one the axis after
                                ///< its own in the order x, y, z; world axes
  double length = 1.0;          ///< converts tilts to lengths [m]
  std::vector<RotorBody> bodies;
};

/// The bodies attached to the joint `name`: revolute, cylindrical, or free with the given axis (in
/// the axes of the joint, through its position on the rotor), or with a detected one
/// (rotor_symmetry.hpp). Throws InputError for another joint, if joints allow relative motion of
/// bodies of the rotor, or if the axis of rotation is ambiguous.
Rotor find_rotor(RelativeFormulation& f, const std::string& name, const std::optional<Vec3>& axis);

/// The bodies of the rotor attached to a joint, whatever its axis.
std::vector<int> rotor_bodies(const Model& model, const std::string& joint);

/// G of a body with this axis through p_BP, from its nodes on the axis.
MatX turning_of_modes(const FlexibleBody& body, const Vec3& axis, const Vec3& p_BP,
                      const std::vector<int>& on_axis);

/// exp(angle G).
MatX turned_modes(const MatX& G, double angle);

}  // namespace floatframe
