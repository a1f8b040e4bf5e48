#include "floatframe/vehicle/lane_gates.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {

std::array<LaneGate, 3> lane_gates(double width) {
  const double half = 0.5 * (1.1 * width + 0.25);  // of section 1
  const double right = half + 1.0;                 // of section 3
  const double last = std::max(1.3 * width + 0.25, 3.0);
  return {LaneGate{1, 0.0, 12.0, -half, half}, LaneGate{3, 25.5, 36.5, right, right + width + 1.0},
          LaneGate{5, 49.0, 61.0, -half, last - half}};
}

// In the axes of the vehicle an edge y = y_e, begin <= x <= end, is a straight segment. Its part
// beside the vehicle, -rear <= X <= front, is nearest at one of its two ends.
double clearance(const LaneGate& gate, const VehicleOutline& vehicle, double x, double y,
                 double yaw) noexcept {
  const double c = std::cos(yaw), s = std::sin(yaw);
  double least = std::numeric_limits<double>::infinity();
  for (const bool left : {true, false}) {
    const double dy = (left ? gate.left : gate.right) - y;
    // X = c dx + s dy between the ends of the vehicle, and dx between those of the gate.
    const double low = std::max(gate.begin - x, (-vehicle.rear - s * dy) / c);
    const double high = std::min(gate.end - x, (vehicle.front - s * dy) / c);
    if (low > high) continue;
    for (const double dx : {low, high}) {
      const double beside = c * dy - s * dx;
      least = std::min(least, (left ? beside : -beside) - 0.5 * vehicle.width);
    }
  }
  return least;
}

}  // namespace floatframe
