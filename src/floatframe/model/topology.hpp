#pragma once
// Spanning tree of the bodies and the joints that must be cut, found from the model: Prim's
// algorithm from the ground, at each step the joint that removes most freedom (fewest relative
// coordinates in the tree), then the one that gives the shortest chain, then file order. Joints
// that are named as cut, by the user or for inertia (build_joints.cpp), never enter the tree.
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

struct Topology {
  struct Link {
    int body = -1;
    int joint = -1;
    int parent = -1;        ///< body, -1: ground
    bool reversed = false;  ///< the joint's child is the tree parent
  };
  std::vector<Link> links;      ///< parents before children
  std::vector<int> cut_joints;  ///< in file order
};

Topology find_topology(const Model& model);

}  // namespace floatframe
