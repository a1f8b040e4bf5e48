#include "floatframe/stepping/time_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floatframe {

long TimeGrid::steps() const noexcept {
  if (std::isinf(duration_)) return std::numeric_limits<long>::max();
  return std::lround(std::max(0.0, std::ceil((duration_ - slack(base_ + duration_)) / step_)));
}

double TimeGrid::slack(double to) const noexcept {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  return 1e-9 * step_ + rounding * (std::abs(base_) + std::abs(to));
}

PlannedStep TimeGrid::next() const noexcept {
  const double from = base_ + static_cast<double>(since_base_) * step_;
  const double to = base_ + static_cast<double>(since_base_ + 1) * step_, end = base_ + duration_;
  PlannedStep s;
  s.to = std::min(to, end);
  s.whole = !(end < to - slack(to));
  s.size = s.whole ? step_ : end - from;
  return s;
}

PlannedStep TimeGrid::of_size(double h, double now) const noexcept {
  if (h == step_) return next();
  return {.size = h, .to = now + h, .whole = false, .on_grid = false};
}

void TimeGrid::made(const PlannedStep& step) noexcept {
  assert(step.size > 0.0);
  if (step.on_grid)
    ++since_base_;
  else
    restore(step.to, 0);
}

}  // namespace floatframe
