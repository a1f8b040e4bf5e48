#include "floatframe/run/step_times.hpp"

namespace floatframe {
namespace {

/// Bins of the histogram that are merged into one: eight per octave remain.
constexpr std::size_t bins_together = Histogram::parts / 8;

}  // namespace

StepTimes step_times(const Histogram& histogram) {
  StepTimes out;
  out.steps = histogram.count();
  if (out.steps == 0) return out;
  out.median = histogram.percentile(0.5);
  out.percent_99 = histogram.percentile(0.99);
  out.largest = histogram.max();
  std::size_t used = 0;  // of `counts`
  for (std::size_t first = 0; first < Histogram::bins; first += bins_together) {
    std::uint64_t steps = 0;
    for (std::size_t k = first; k < first + bins_together; ++k) steps += histogram.count(k);
    if (steps == 0 && out.counts.empty()) continue;
    if (out.counts.empty()) out.edges.push_back(Histogram::lower(first));
    out.counts.push_back(steps);
    out.edges.push_back(Histogram::upper(first + bins_together - 1));
    if (steps > 0) used = out.counts.size();
  }
  out.counts.resize(used);
  out.edges.resize(used + 1);
  return out;
}

}  // namespace floatframe
