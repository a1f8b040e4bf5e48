#include "floatframe/stepping/time_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floatframe {

long TimeGrid::steps() const noexcept {
  if (std::isinf(duration_)) return std::numeric_limits<long>::max();
  return std::max(0L, std::lround(std::ceil(duration_ / step_ - 1e-9)));
}

PlannedStep TimeGrid::next() const noexcept {
  const double from = base_ + static_cast<double>(since_base_) * step_;
  PlannedStep s;
  s.to = std::min(base_ + static_cast<double>(since_base_ + 1) * step_, base_ + duration_);
  s.whole = !(s.to - from < (1.0 - 1e-9) * step_);
  s.size = s.whole ? step_ : s.to - from;
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
