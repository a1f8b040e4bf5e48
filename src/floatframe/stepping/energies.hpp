#pragma once
// The energies of a system at one state.

namespace floatframe {

struct Energies {
  double kinetic = 0.0;
  double potential = 0.0;  ///< of gravity and force elements
  double elastic = 0.0;    ///< of modes [J]
  double total() const noexcept { return kinetic + potential + elastic; }
};

}  // namespace floatframe
