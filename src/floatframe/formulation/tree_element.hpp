#pragma once
// What connects markers of a tree - a constraint part or a force element - in the front of its
// cluster: the coordinates that move one of the markers, and its rows over them.
//   row of a gradient (F, T) on each marker:  d(measure)/dx_k = sum over the markers of
//     F.u_k + T.omega_k,   u_k = v_k + omega_k x r,   (v_k, omega_k) the twist of coordinate k
//   rows of the distance:   d(r_b - r_a)/dx_k of two markers, three rows
// Coordinates above the lowest common ancestor move all markers equally and cancel; they are not
// on the path.
#include <span>
#include <vector>

#include "floatframe/formulation/clusters.hpp"
#include "floatframe/formulation/tree_kinematics.hpp"

namespace floatframe {

/// A range of coordinates on the path from a marker to the common ancestor.
struct PathEntry {
  enum class What {
    joint,         ///< of `body`
    own_modes,     ///< of `body`: move its marker M
    parent_modes,  ///< of the parent of `body`: move the marker F of its joint
    marker_modes   ///< of `body`: move the element's marker on it
  } what;
  int body, marker;
  int port;          ///< number of the marker
  int front, count;  ///< position in the front of the cluster
};

struct TreeElement {
  std::vector<int> markers;
  int cluster = -1;  ///< -1: at most one body moves
  int body = -1;     ///< that body
  std::vector<PathEntry> path;
  int first = 0, width = 0;  ///< the range of the front that the path touches, in whole lanes
  int gradient = 0;          ///< position of the rows of a constraint part in a factorisation
};

/// The bodies of markers, each once, without the ground.
std::vector<int> bodies_of(const TreeKinematics& tree, std::span<const int> markers);

/// For any markers, of which at least one is on a body. Without a cluster if no coordinate changes
/// their relative position.
TreeElement make_element(const TreeKinematics& tree, const std::vector<Cluster>& clusters,
                         const std::vector<int>& cluster_of_body, std::span<const int> markers);

/// The gradient over the element's range of the front (`width` numbers).
void fill_gradient(const TreeKinematics& tree, const TreeElement& e, const Wrench* gradient,
                   double* row) noexcept;
/// d(r_b - r_a) over the element's range of the front, three rows of `width` numbers.
void fill_distance(const TreeKinematics& tree, const TreeElement& e, double* rows) noexcept;

}  // namespace floatframe
