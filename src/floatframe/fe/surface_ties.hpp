#pragma once
// Nodes tied to faces of other elements. A node at the point p of a face, at the distance g along
// its normal n, moves as the surface does there:
//   u = sum_i N_i(p) u_i + g dn,   dn = -sum_i grad N_i(p) (n . u_i)
// with the shape functions N of the face and their gradients along it, so that the motion of a
// rigid face moves the node rigidly at any distance. Outside the face N continues linearly.
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct SurfaceTie {
  std::vector<int> nodes;          ///< that follow
  std::vector<ElementFace> faces;  ///< of elements of the model, of 3, 4, 6 or 8 nodes
  /// Nodes farther than this from all faces are left free; 0: `part_of_size` of the mean size of
  /// the faces.
  double distance = 0.0;
  /// Nodes are moved onto the faces first.
  bool adjust = true;
  /// Rotations follow too, where node and face both have them (shells).
  bool rotations = true;
  double part_of_size = 0.025;
  FeSource source;
};

struct TiedNodes {
  int tied = 0;
  std::vector<int> free;      ///< nodes that are too far from all faces
  double nearest_free = 0.0;  ///< distance of the nearest of them [as the positions]
  double distance = 0.0;      ///< the limit that was taken
  double moved = 0.0;         ///< largest displacement of a node by `adjust`
};

/// Adds equations for displacements (and moves nodes). Nodes of the faces themselves are skipped,
/// and so are nodes marked in `taken`, one entry per node; tied nodes are marked.
TiedNodes add_surface_tie(FeModel& model, const SurfaceTie& tie, std::vector<char>& taken);

}  // namespace floatframe
