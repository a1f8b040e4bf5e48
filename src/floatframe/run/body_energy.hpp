#pragma once
// The kinetic energy of a body from its velocities in body axes. It is cheap enough for every
// recorded instant: it avoids the mass matrix, which costs three times as much.
//   T = m v.v / 2 + v . (w x m_bar + S ydot) + w . J w / 2 + w . h + ydot . M_ff ydot / 2
//   m_bar = m_u + S y (29),  J = tr(P_bar) 1 - P_bar (33),  h = int rho x rhodot dm
// rho = u + X y is the position of a point in the body frame, v the velocity of its origin, w its
// angular velocity. Sums over pairs of modes (a <= b) use that S^ij + S^ji is symmetric and
// S^ij - S^ji is not. Geometric stiffening: S(y), P_bar of inertia/preprocessing.hpp.
#include <array>
#include <vector>

#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/second_order.hpp"

namespace floatframe {

class BodyEnergy {
 public:
  /// `second_order`: second-order terms at the masses (second_order_on_masses); null: none.
  explicit BodyEnergy(const InertiaInvariants& invariants,
                      const SecondOrder* second_order = nullptr);

  /// y, ydot: one entry per mode.
  double kinetic(const Vec3& v, const Vec3& w, const double* y, const double* ydot) const noexcept;

 private:
  /// S^11, S^22, S^33, S^12+S^21, S^13+S^31, S^23+S^32, twice where a < b; M_ff as well; then
  /// int (X_a x X_b) dm.
  using Pair = std::array<double, 10>;
  double m_;
  Vec3 m_u_;
  Mat3 P_u_;
  int modes_;
  std::vector<Vec3> S_;                    ///< of each mode
  std::vector<std::array<double, 9>> Si_;  ///< of each mode: 3i+j is row j of S^i
  std::vector<Pair> pairs_;                ///< (0,0), (0,1), ..., (1,1), ...
  /// Second-order terms of pairs of modes: S2, and int r_u x h dm.
  std::vector<std::array<Vec3, 2>> second_;
};

}  // namespace floatframe
