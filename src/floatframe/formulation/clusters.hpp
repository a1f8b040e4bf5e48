#pragma once
// Clusters of a tree: sets of bodies that loop constraints or two-body forces couple below their
// lowest common ancestor. A cluster has one parent body p. In a chain every body is a cluster; in a
// vehicle every suspension is one, and the chassis is the last.
#include <span>
#include <utility>
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
/// their fronts are narrow. `ties`: pairs of markers connected by one element.
std::vector<Cluster> find_clusters(const TreeKinematics& tree,
                                   std::span<const std::pair<int, int>> ties);

/// Numbers the coordinates of the tree cluster by cluster.
void number_coordinates(TreeKinematics& tree, std::vector<Cluster>& clusters);

/// The bodies on the path from this one to the ground.
std::vector<int> path_to_root(const TreeKinematics& tree, int body);

}  // namespace floatframe
