#pragma once

namespace floatframe {

/// Distribution of the mass of an element.
enum class MassForm {
  consistent,  ///< int rho N N^T dV of its shape functions
  lumped,      ///< at its nodes, with the rotary inertia of sections and thicknesses
  /// At its nodes as masses without rotary inertia, except about the axis of beams.
  lumped_without_rotation
};

}  // namespace floatframe
