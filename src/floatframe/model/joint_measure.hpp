#pragma once
// Joint coordinates and velocities measured at the two markers of a joint: the same numbers in
// every formulation, for tree and cut joints. Angles are within half a turn of `reference` so that
// a caller can track several turns.
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

double joint_position(const Joint& joint, const MarkerState& F, const MarkerState& M, int component,
                      double reference) noexcept;
double joint_velocity(const Joint& joint, const MarkerState& F, const MarkerState& M,
                      int component) noexcept;

/// Roll, pitch, yaw of R = Rz(yaw) Ry(pitch) Rx(roll).
Vec3 roll_pitch_yaw(const Mat3& R) noexcept;

}  // namespace floatframe
