#pragma once

namespace floatframe {

/// How the mass of an element is spread.
enum class MassForm {
  consistent,  ///< int rho N N^T dV of its shape functions
  lumped,      ///< at its nodes, with the rotary inertia of sections and thicknesses
  /// At its nodes as masses without rotary inertia, but of beams that about their own axis.
  lumped_without_rotation
};

}  // namespace floatframe
