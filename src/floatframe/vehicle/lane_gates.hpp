#pragma once
// The track of the obstacle avoidance manoeuvre, ISO 3888-2, and how far a vehicle stays from its
// cones. With the width b of the vehicle (without mirrors), all lengths in m:
//
//   section  length  lane
//   1        12      width 1.1 b + 0.25
//   2        13.5    free
//   3        11      width b + 1, its right edge 1 m to the left of the left edge of section 1
//   4        12.5    free
//   5        12      width max(1.3 b + 0.25, 3), its right edge that of section 1
//
// x runs along the track from the entry, y to the left from the centre line of section 1. The cones
// stand along both edges of sections 1, 3 and 5; each edge is taken as a wall, which is stricter
// than single cones.
#include <array>
#include <limits>

namespace floatframe {

struct LaneGate {
  int section = 0;
  double begin = 0.0, end = 0.0;   ///< along x [m]
  double right = 0.0, left = 0.0;  ///< the edges, y [m]
};

/// Sections 1, 3 and 5 for a vehicle of this width [m].
std::array<LaneGate, 3> lane_gates(double width);

/// The outline of a vehicle: a rectangle about its reference point [m].
struct VehicleOutline {
  double width = 0.0;
  double front = 0.0, rear = 0.0;  ///< from the reference point to the ends, both positive
};

/// The smallest distance of a side of the vehicle from an edge of the gate [m], negative: the edge
/// is crossed; infinite: the vehicle is not at the gate. `x`, `y` of the reference point on the
/// track, heading `yaw` [rad] within a quarter of a turn of the track's.
double clearance(const LaneGate& gate, const VehicleOutline& vehicle, double x, double y,
                 double yaw) noexcept;

}  // namespace floatframe
