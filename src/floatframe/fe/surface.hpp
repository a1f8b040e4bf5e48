#pragma once
// The outer surface of a finite-element model.
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

}  // namespace floatframe
