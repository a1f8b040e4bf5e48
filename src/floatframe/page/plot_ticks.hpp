#pragma once
// Tick positions of plots.
#include <cstddef>

namespace floatframe {

inline constexpr std::size_t max_curves_per_plot = 4;

/// Evenly spaced round numbers (1, 2, 5 times a power of ten).
struct Ticks {
  double first = 0, step = 1;
  int count = 0;
  double at(int i) const { return first + i * step; }
};
/// About the given number of ticks within [low, high].
Ticks nice_ticks(double low, double high, int about);

}  // namespace floatframe
