#pragma once
// Motion of a marker in the world, as the formulations supply it to joints and forces, and the
// wrench they return.
#include "floatframe/math/types.hpp"

namespace floatframe {

struct MarkerState {
  Vec3 r;                   ///< position relative to the evaluation origin [m]
  Mat3 R;                   ///< orientation
  Vec3 v, w;                ///< velocity of the point [m/s], angular velocity [rad/s]
  Vec3 a_bias, alpha_bias;  ///< acceleration and angular acceleration when all coordinate
                            ///< accelerations are zero
};

/// Gradient of a scalar measure of two markers: d(measure) = Fa.dr_a + Ta.dpi_a + Fb.dr_b +
/// Tb.dpi_b.
struct WrenchRow {
  Vec3 Fa, Ta, Fb, Tb;
};

}  // namespace floatframe
