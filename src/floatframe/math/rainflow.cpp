#include "floatframe/math/rainflow.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {

std::vector<std::size_t> turning_points(std::span<const double> values) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (out.empty()) {
      out.push_back(k);
      continue;
    }
    const double step = values[k] - values[out.back()];
    if (step == 0.0) continue;
    const bool goes_on =
        out.size() > 1 && (step > 0.0) == (values[out.back()] > values[out[out.size() - 2]]);
    if (goes_on)
      out.back() = k;
    else
      out.push_back(k);
  }
  if (out.size() < 2) out.clear();
  return out;
}

std::vector<RainflowCycle> rainflow(std::span<const double> values) {
  std::vector<RainflowCycle> out;
  std::vector<std::size_t> left;
  const auto range = [&](std::size_t k) { return std::abs(values[left[k + 1]] - values[left[k]]); };
  const auto count = [&](std::size_t k, double n) {
    const double a = values[left[k]], b = values[left[k + 1]];
    out.push_back({std::abs(b - a), 0.5 * a + 0.5 * b, n, left[k], left[k + 1]});
  };
  for (const std::size_t point : turning_points(values)) {
    left.push_back(point);
    while (left.size() >= 3) {
      const std::size_t n = left.size();
      if (range(n - 2) < range(n - 3)) break;
      if (n == 3) {
        count(0, 0.5);
        left.erase(left.begin());
      } else {
        count(n - 3, 1.0);
        left.erase(left.end() - 3, left.end() - 1);
      }
    }
  }
  for (std::size_t k = 0; k + 1 < left.size(); ++k) count(k, 0.5);
  return out;
}

double equivalent_range(std::span<const RainflowCycle> found, double slope, double cycles) {
  double largest = 0.0;
  for (const RainflowCycle& c : found) largest = std::max(largest, c.range);
  if (!(largest > 0.0)) return 0.0;
  double sum = 0.0;  // relative to the largest, so that powers do not overflow
  for (const RainflowCycle& c : found) sum += c.count * std::pow(c.range / largest, slope);
  return largest * std::pow(sum / cycles, 1.0 / slope);
}

}  // namespace floatframe
