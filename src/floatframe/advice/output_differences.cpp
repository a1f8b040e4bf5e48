#include "floatframe/advice/output_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floatframe {

std::vector<OutputDifference> output_scales(const ResultTable& full, const ResultTable& other,
                                            std::size_t outputs) {
  std::vector<OutputDifference> out;
  for (std::size_t c = 1; c <= outputs; ++c) {
    OutputDifference d;
    d.name = full.columns[c].name;
    d.unit = full.columns[c].unit;
    double low = 0.0, high = 0.0;
    for (std::size_t r = 0; r < full.rows(); ++r) {
      const double x = full.at(r, c);
      low = r == 0 ? x : std::min(low, x);
      high = r == 0 ? x : std::max(high, x);
      if (r < other.rows()) d.noise = std::max(d.noise, std::abs(x - other.at(r, c)));
    }
    d.range = high - low;
    out.push_back(std::move(d));
  }
  return out;
}

std::vector<OutputDifference> output_differences(const std::vector<OutputDifference>& scale,
                                                 const ResultTable& full,
                                                 const ResultTable& reduced) {
  std::vector<OutputDifference> out;
  for (std::size_t c = 1; c < reduced.columns.size(); ++c) {
    std::size_t f = 0;
    while (f < scale.size() && scale[f].name != reduced.columns[c].name) ++f;
    if (f == scale.size()) continue;
    OutputDifference d = scale[f];
    double largest_range = 0.0;
    for (const OutputDifference& other : scale)
      if (other.unit == d.unit) largest_range = std::max(largest_range, other.range);
    const std::size_t rows = std::min(full.rows(), reduced.rows());
    double high[2] = {0, 0}, low[2] = {0, 0};
    for (std::size_t r = 0; r < rows; ++r) {
      const double x[2] = {full.at(r, f + 1), reduced.at(r, c)};
      for (int i = 0; i < 2; ++i) {
        high[i] = r == 0 ? x[i] : std::max(high[i], x[i]);
        low[i] = r == 0 ? x[i] : std::min(low[i], x[i]);
      }
      d.largest = std::max(d.largest, std::abs(x[0] - x[1]));
      d.rms += (x[0] - x[1]) * (x[0] - x[1]) / static_cast<double>(rows);
    }
    d.rms = std::sqrt(d.rms);
    d.peaks = std::max(std::abs(high[0] - high[1]), std::abs(low[0] - low[1]));
    const double judged = std::max(d.rms, d.peaks);
    const bool still = d.range <= 1e-3 * largest_range && d.largest <= 10.0 * d.noise;
    const double range = std::max(d.range, 1e-6 * largest_range);
    if (full.rows() != reduced.rows())
      d.relative = std::numeric_limits<double>::infinity();
    else if (judged > 0.0 && !still)
      d.relative = range > 0.0 ? judged / range : std::numeric_limits<double>::infinity();
    out.push_back(std::move(d));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.relative > b.relative; });
  return out;
}

}  // namespace floatframe
