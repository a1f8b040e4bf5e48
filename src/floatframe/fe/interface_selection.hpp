#pragma once
// Interfaces of a part, to hold, drive or observe it: chosen nodes, tied to one reference point.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Selection of nodes. Exactly one of the criteria is used. Lengths in SI.
struct NodeChoice {
  enum class By {
    set,       ///< node set, physical group or element set (its nodes); or surface
    node,      ///< one node by its number in the file
    nearest,   ///< the node nearest to `point`
    plane,     ///< nodes within `tolerance` of the plane through `point` with normal `axis`
    cylinder,  ///< nodes within `tolerance` of the cylinder with `axis` through `point`, `radius`;
               ///< |distance along the axis| <= half of `length` if that is positive
    sphere     ///< nodes within `tolerance` of the sphere about `point` with `radius`
  };
  By by = By::set;
  std::string set;
  int number = 0;
  Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ();
  double radius = 0.0, length = 0.0;
  double tolerance = 0.0;  ///< 0: 1e-3 of the radius, for planes of the size of the part
};

struct InterfaceDescription {
  std::string name;
  NodeChoice choice;
  std::optional<Vec3> at;  ///< reference point [m]. Default: centre of the nodes' bounding box in
                           ///< the directions that the choice does not fix; on the axis of a
                           ///< cylinder, in the centre of a sphere
  Spider::Kind kind = Spider::Kind::rigid;
  unsigned mask = 63u;  ///< the dofs of the interface, bit 0..5 = ux..rz
};

/// Nodes of a choice in a valid model, in ascending order (sets: their own order); nodes generated
/// by a reader (`FeModel::generated_nodes`) have a number, but no position. Throws InputError if
/// there are none, with the selection and what is available (sets with did-you-mean; the distance
/// of the nearest node).
std::vector<int> choose_nodes(const FeModel& model, const NodeChoice& choice);

/// Adds a reference node and a spider to the model and returns the index of the reference node,
/// named after the interface. A choice of one node that has rotations (of a beam, or the
/// reference of a spider in the deck) is itself the reference; so is the reference of a deck's
/// spider over the same nodes, of any kind. One node of a solid: itself, with three dofs (`mask`
/// must agree: at most bits 0..2). Throws InputError: fewer than three nodes, collinear nodes, a
/// node that belongs to another spider.
int add_interface(FeModel& model, const InterfaceDescription& interface);

}  // namespace floatframe
