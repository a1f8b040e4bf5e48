#pragma once
// Rainflow counting of a history as in ASTM E1049-85 (2017), section 5.4.4: ranges between turning
// points that close a loop are cycles, the remaining ones half cycles. With X the range at the end
// of the history read so far and Y the one before it, Y is counted as soon as X >= Y: as a half
// cycle if it contains the first remaining point, which is then dropped, else as a cycle, whose two
// points are dropped.
#include <cstddef>
#include <span>
#include <vector>

namespace floatframe {

/// Indices of the turning points, with the first and the last value; of a plateau its first. Empty
/// if all values are equal.
std::vector<std::size_t> turning_points(std::span<const double> values);

struct RainflowCycle {
  double range = 0.0, mean = 0.0;
  double count = 0.0;              ///< 1, or 0.5 of a half cycle
  std::size_t begin = 0, end = 0;  ///< indices of its two points in the history
};

/// In the order in which they are found.
std::vector<RainflowCycle> rainflow(std::span<const double> values);

/// The range that causes the same damage in `cycles` cycles as all of these with an S-N curve of
/// that slope (Palmgren, Miner): (sum n_i range_i^m / cycles)^(1/m).
double equivalent_range(std::span<const RainflowCycle> found, double slope, double cycles);

}  // namespace floatframe
