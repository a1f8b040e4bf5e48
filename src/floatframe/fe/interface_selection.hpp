#pragma once
// Places on a part where it is held, driven or watched: chosen nodes, tied to one reference point.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Which nodes. Exactly one of the ways is used. Lengths in SI.
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

/// Nodes of a choice in a valid model, in ascending order (sets: their own order); those that a
/// reader made (`FeModel::generated_nodes`) have a number, but no place. Throws InputError if there
/// are none, naming what was looked for and what there is (sets with did-you-mean; the distance of
/// the nearest node).
std::vector<int> choose_nodes(const FeModel& model, const NodeChoice& choice);

/// Adds a reference node and a spider to the model and returns the index of the reference node,
/// whose name is the interface's. A choice of one node that has rotations (of a beam, or the
/// reference of a spider in the deck) is itself the reference; so is the reference of a deck's
/// spider over the same nodes, of whatever kind. One node of a solid: itself, with three dofs
/// (`mask` must say so: at most bits 0..2). Throws InputError: fewer than three nodes, nodes on a
/// line, a node that belongs to another spider.
int add_interface(FeModel& model, const InterfaceDescription& interface);

}  // namespace floatframe
