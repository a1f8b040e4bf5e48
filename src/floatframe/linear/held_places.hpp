#pragma once
// Roots of zero that are no rigid motions. Friction by bristles s, sdot = v, holds a coordinate x
// wherever it is: A z = 0 of z = (x, v = 0, s = 0). Moved slowly, x takes the states without an
// equation at rest along, ds = sdot_v x, and their force holds it. With E of the states of
// elements, V of the velocities and X of the increments, each of z, and E+, V+ back,
//   P = V A E+ D E A V+ X,  D = 1 for states without an equation at rest, else 0                (1)
// is the acceleration by which they do: P z = 0 of a z that nothing holds.
#include "floatframe/linear/linear_system.hpp"

namespace floatframe {

class HeldPlaces {
 public:
  explicit HeldPlaces(const LinearSystem& system);

  /// Of a mode with the root zero.
  bool holds(const LinearMode& mode) const;
  /// The combinations of these, columns with the root zero and independent increments, that nothing
  /// holds.
  MatX free(const MatX& z) const;

 private:
  const LinearSystem& system_;
  MatX P_;  ///< (1); empty: nothing is held so
};

}  // namespace floatframe
