#pragma once
// Beams beside their nodes as CalculiX has them: OFFSET1 and OFFSET2 of *BEAM SECTION, in
// thicknesses along directions 1 and 2 of the section, the centroid at
//   -OFFSET1 t_1 n_1 - OFFSET2 t_2 n_2
// of the node. Beams at one node are joined rigidly there whatever their offsets, which equations
// between their rotations cannot say (CalculixEquations).
#include <array>
#include <optional>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// A model whose beams are at the nodes that rigid arms tied them to, without these arms.
struct OffsetBeams {
  FeModel model;
  std::vector<std::array<double, 2>> offsets;  ///< of each element, in thicknesses
  std::vector<char> left_out;                  ///< nodes at the ends of arms, of nothing now
};

/// None if no end of a beam with a rectangular or round section hangs on a rigid arm across it, one
/// in both directions the same at all its nodes, and of nothing else.
std::optional<OffsetBeams> offset_beams(const FeModel& model);

}  // namespace floatframe
