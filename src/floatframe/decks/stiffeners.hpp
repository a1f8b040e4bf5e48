#pragma once
// Beams along shells and offset from them: stiffeners. A twisted shell moves the centroid of
// such a beam sideways, and the axis of the beam turns about the normal of the shell. Tied rigidly
// to the shell the beam rotates its nodes likewise, which shells here resist and those of most
// programs hardly do: a rib on a plate was 34 % too stiff in twist (docs/finite-elements.md). So
// there the rotation of the shells about their normal is independent; the node follows the beam.
#include <array>
#include <span>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// A beam as in the file.
struct BeamOnNodes {
  std::array<int, 3> nodes{-1, -1, -1};  ///< of the file
  bool offset = false;                   ///< its axis is not at them
  bool holds = false;  ///< it is tied to them in all rotations, and bends about any axis across it
};

/// Gives shells an independent rotation at nodes where a rigidly tied stiffener runs along them, if
/// the shells are smooth and every beam runs along them; one note with the number of nodes.
void free_drilling_at_stiffeners(FeModel& model, std::span<const BeamOnNodes> beams);

}  // namespace floatframe
