#pragma once
// Turns that nothing resists. A rigid spider or a straight bar whose nodes belong to solid
// elements, which have no rotations, is held by the places of these nodes. If all of them lie on
// one line, nothing resists its turn about that line, and nothing feels it: the stiffness is
// singular there, though the part is no mechanism. Nastran's AUTOSPC holds such a turn in space,
// which a part that moves cannot be; here it follows the elements around a node that holds the
// group:
//   a . theta = a . J^-1 sum_i r_i x u_i,  J = sum_i (r_i^2 1 - r_i r_i^T)
// with the nodes i of the elements and their places r_i about their centre. Rigid motions satisfy
// it, and as nothing resists the turn no force comes of it. Whatever has mass beside the line makes
// it a mechanism, which stays one.
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct FreeTurn {
  int node = -1;           ///< whose rotation is that of the group
  bool every_way = false;  ///< held in one point: about every axis, else about `axis`
  Vec3 axis = Vec3::UnitX();
  double length = 0.0;      ///< farthest node of the group from what holds it [m]
  std::vector<int> group;   ///< nodes that turn together, ascending
  int holder = -1;          ///< node of elements that holds the group
  std::vector<int> around;  ///< nodes of these elements, without those that the group moves
  std::string label;        ///< of the spider or bar
  FeSource source;
};

/// Those of a valid model. None of a model of matrices: what does not turn has no row there.
std::vector<FreeTurn> free_turns(const FeModel& model);
/// The turns about their lines of the references of mean spiders whose nodes lie on a line. Throws
/// InputError where no elements beside the line show how the part turns there.
std::vector<FreeTurn> line_turns(const FeModel& model);

/// Is a node of the group beside the line or point that holds it? A force there turns the group.
bool is_beside(const FeModel& model, const FreeTurn& turn, int node);

/// Adds the equations, and with `note` one note that counts them.
void tie_free_turns(FeModel& model, const std::vector<FreeTurn>& turns, bool note = true);

}  // namespace floatframe
