#pragma once
// What the bearing of a joint carries of its reaction: the force F and the torque T about the point
// M on the child, e the axis. A bearing of the length L holds at its two ends, L/2 from M to each
// side; two forces there balance the part of F across the axis and that of T:
//   R_1,2 = (F - (e.F) e) / 2 +- (T x e) / L                                                   (1)
// and the load is across (|R_1| + |R_2|) + along |e.F|, with the factors of the port. Without a
// length the point M alone holds: |R_1| + |R_2| = |F - (e.F) e|.
// Assumption: joints move along or about e only, so a force along the motion changes no load.
#include <cmath>

#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// World axes; [N] or [N m], not negative.
inline double joint_load(const LoadPort& port, const Vec3& e, const Vec3& F,
                         const Vec3& T) noexcept {
  const double axial = e.dot(F);
  const Vec3 across = F - axial * e;
  double radial = 0.0;
  if (port.length > 0.0) {
    const Vec3 couple = T.cross(e) / port.length;  // (1)
    radial = (0.5 * across + couple).norm() + (0.5 * across - couple).norm();
  } else {
    radial = across.norm();
  }
  return port.across * radial + port.along * std::abs(axial);
}

}  // namespace floatframe
