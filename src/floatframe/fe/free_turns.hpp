#pragma once
// Rotations without stiffness. A rigid spider or a straight bar whose nodes belong to solid
// elements, which have no rotations, is held by the displacements of these nodes. If all of them
// are on one line, the rotation about that line has neither stiffness nor load: the stiffness is
// singular there, though the part is no mechanism. Nastran's AUTOSPC fixes such a rotation in
// space, which is wrong for a moving part; here it follows the elements around a node that holds
// group:
//   a . theta = a . J^-1 sum_i r_i x u_i,  J = sum_i (r_i^2 1 - r_i r_i^T)
// with the nodes i of the elements and their positions r_i from their centre. Rigid motions satisfy
// it, and since the rotation has no stiffness it causes no force. Any mass off the line makes it
// a mechanism, which is left as it is.
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct FreeTurn {
  int node = -1;           ///< whose rotation is that of the group
  bool every_way = false;  ///< held in one point: about every axis, else about `axis`
  Vec3 axis = Vec3::UnitX();
  double length = 0.0;      ///< farthest node of the group from what holds it [m]
  std::vector<int> group;   ///< nodes that rotate together, ascending
  int holder = -1;          ///< node of elements that holds the group
  std::vector<int> around;  ///< nodes of these elements, without those that the group moves
  std::string label;        ///< of the spider or bar
  FeSource source;
};

/// For a valid model. None for a model of matrices: nodes without rotation have no row there.
std::vector<FreeTurn> free_turns(const FeModel& model);
/// The rotations about their lines of the references of mean spiders with collinear nodes. Throws
/// InputError if no elements off the line define the rotation of the part there.
std::vector<FreeTurn> line_turns(const FeModel& model);

/// Is a node of the group off the line or point that holds it? A force there rotates the group.
bool is_beside(const FeModel& model, const FreeTurn& turn, int node);

/// Adds the equations, and with `note` one note with their number.
void tie_free_turns(FeModel& model, const std::vector<FreeTurn>& turns, bool note = true);

}  // namespace floatframe
