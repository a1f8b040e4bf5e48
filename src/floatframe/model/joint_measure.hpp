#pragma once
// Joint coordinates and velocities measured at the two markers of a joint: the same numbers in
// every formulation, for tree and cut joints. Angles are within half a turn of `reference` so that
// a caller can track several turns.
#include <cmath>

#include "floatframe/math/dual.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

double joint_position(const Joint& joint, const MarkerState& F, const MarkerState& M, int component,
                      double reference) noexcept;
Dual joint_position(const Joint& joint, const MarkerMotion<Dual>& F, const MarkerMotion<Dual>& M,
                    int component, double reference) noexcept;
double joint_velocity(const Joint& joint, const MarkerState& F, const MarkerState& M,
                      int component) noexcept;
Dual joint_velocity(const Joint& joint, const MarkerMotion<Dual>& F, const MarkerMotion<Dual>& M,
                    int component) noexcept;

/// Roll, pitch, yaw of R = Rz(yaw) Ry(pitch) Rx(roll).
template <class S>
Eigen::Matrix<S, 3, 1> roll_pitch_yaw(const Eigen::Matrix<S, 3, 3>& R) noexcept {
  using std::atan2, std::sqrt;
  const S cos_pitch = sqrt(S(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0)));
  return {atan2(R(2, 1), R(2, 2)), atan2(S(-R(2, 0)), cos_pitch), atan2(R(1, 0), R(0, 0))};
}

}  // namespace floatframe
