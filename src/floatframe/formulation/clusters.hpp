#pragma once
// Clusters of a tree: sets of bodies that loop constraints or two-body forces couple below their
// lowest common ancestor. A cluster has one parent body p. In a chain every body is a cluster; in a
// vehicle every suspension is one, and the chassis is the last.
#include <span>
#include <vector>

#include "floatframe/formulation/tree_kinematics.hpp"

namespace floatframe {

struct Cluster {
  std::vector<int> bodies;   ///< parents before children
  int parent = -1;           ///< parent body, -1: ground
  int offset = 0, size = 0;  ///< velocity coordinates of its bodies
  int n = 0;                 ///< size of its front: [coordinates | Z_p | y_p]
};

/// Clusters with fewer coordinates are factorised as full fronts.
inline constexpr int wide_cluster = 100;

/// The clusters, parents before children. Coupled bodies of wide clusters are consecutive, so that
/// their fronts are narrow. `ties`: the markers connected by one element or part.
std::vector<Cluster> find_clusters(const TreeKinematics& tree,
                                   std::span<const std::vector<int>> ties);

/// Numbers the coordinates of the tree cluster by cluster.
void number_coordinates(TreeKinematics& tree, std::vector<Cluster>& clusters);

/// From the body of each marker the bodies on the path to the lowest common ancestor of all,
/// without it.
struct MarkerPaths {
  int ancestor = -1;
  std::vector<std::vector<int>> paths;
};
MarkerPaths paths_of(const TreeKinematics& tree, std::span<const int> markers);

}  // namespace floatframe
