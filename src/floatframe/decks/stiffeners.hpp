#pragma once
// Beams along shells and beside them: stiffeners. A shell that is twisted moves the centroid of
// such a beam sideways, and the axis of the beam turns about the normal of the shell. Tied rigidly
// to the shell the beam makes its nodes turn so, which shells here resist and those of most
// programs hardly do: a rib on a plate was 34 % too stiff in twist (docs/finite-elements.md). So
// there the turn of the shells about their normal is their own, and the node turns with the beam.
#include <array>
#include <span>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// A beam as the file has it.
struct BeamOnNodes {
  std::array<int, 3> nodes{-1, -1, -1};  ///< of the file
  bool beside = false;                   ///< its axis is not at them
  bool holds = false;  ///< it is tied to them in all rotations, and bends about any axis across it
};

/// Gives shells their own turn at nodes from which a stiffener that holds goes along them, where
/// the shells are smooth and every beam goes along them; one note that counts these nodes.
void free_drilling_at_stiffeners(FeModel& model, std::span<const BeamOnNodes> beams);

}  // namespace floatframe
