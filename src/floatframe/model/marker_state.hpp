#pragma once
// Motion of a marker in the world, as the formulations supply it to joints and forces, and the
// wrench they return.
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct CurveFoot;

struct MarkerState {
  Vec3 r;                   ///< position relative to the evaluation origin [m]
  Mat3 R;                   ///< orientation
  Vec3 v, w;                ///< velocity of the point [m/s], angular velocity [rad/s]
  Vec3 a_bias, alpha_bias;  ///< acceleration and angular acceleration when all coordinate
                            ///< accelerations are zero
  /// Of a marker that slides along nodes of its body (model/slide_path.hpp): where its path is,
  /// body axes; else null.
  const CurveFoot* foot = nullptr;
};

/// Debug builds: NaN until they are computed.
inline void poison_rates(MarkerState& s) noexcept {
  poison(s.v);
  poison(s.w);
  poison(s.a_bias);
  poison(s.alpha_bias);
}
inline void poison_state(MarkerState& s) noexcept {
  poison(s.r);
  poison(s.R);
  poison_rates(s);
}

/// Pose and twist of a marker over any scalar, for laws that are differentiated (math/dual.hpp).
template <class S>
struct MarkerMotion {
  Eigen::Matrix<S, 3, 1> r;
  Eigen::Matrix<S, 3, 3> R;
  Eigen::Matrix<S, 3, 1> v, w;
};

/// Force and torque on a marker, world axes, at its point.
template <class S>
struct WrenchOf {
  Eigen::Matrix<S, 3, 1> F, T;
};
using Wrench = WrenchOf<double>;

/// Gradient of a scalar measure of two markers: d(measure) = a.F.dr_a + a.T.dpi_a + b.F.dr_b +
/// b.T.dpi_b.
template <class S>
struct WrenchPair {
  WrenchOf<S> a, b;
};
using WrenchRow = WrenchPair<double>;

/// Small motions of two markers: (dr_a, dpi_a, dr_b, dpi_b), translations and rotations in world
/// axes, R_new = exp(skew(dpi)) R. Rates: (v_a, w_a, v_b, w_b).
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

/// Offsets of the four parts in a Vec12.
namespace part_of {
inline constexpr int r_a = 0, pi_a = 3, r_b = 6, pi_b = 9;
}

inline Vec12 stacked(const WrenchRow& g) noexcept {
  Vec12 x;
  x << g.a.F, g.a.T, g.b.F, g.b.T;
  return x;
}

}  // namespace floatframe
