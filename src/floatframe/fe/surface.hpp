#pragma once
// The outer surface of a finite-element model, for pictures, and the stresses there.
#include <array>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct Surface {
  std::vector<int> nodes;                     ///< node indices of the FE model, ascending
  std::vector<std::array<int, 3>> triangles;  ///< indices into `nodes`, outward normals
  std::vector<std::array<int, 2>> lines;      ///< of beams, indices into `nodes`
};

/// Faces that belong to one solid element only (quadratic faces are divided), shells, lines of
/// beams.
Surface outer_surface(const FeModel& model);

/// Stresses (xx yy zz xy yz zx) [Pa] at the nodes of the surface for displacement fields given as
/// columns (3 nodes() rows: translations of all nodes): 6 nodes.size() rows, averaged over the
/// solid elements at a node; zero where there are none.
MatX surface_stresses(const FeModel& model, const Surface& surface, const MatX& translations);

}  // namespace floatframe
