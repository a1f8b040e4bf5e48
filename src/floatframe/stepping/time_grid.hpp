#pragma once
// The times of the steps of a run. Step k ends at base + (k + 1) h, so that rounding does not
// accumulate, and has exactly the size h, not a difference of times that varies in its last bits;
// only the last step of a duration may be shorter.
#include <cassert>
#include <cstdint>
#include <limits>

namespace floatframe {

/// A planned step.
struct PlannedStep {
  double size = 0.0;    ///< [s]
  double to = 0.0;      ///< its end [s]
  bool whole = true;    ///< of the size of the grid
  bool on_grid = true;  ///< false: the grid begins anew at its end
};

class TimeGrid {
 public:
  static constexpr double endless = std::numeric_limits<double>::infinity();

  /// `duration`: counted from `base` [s].
  TimeGrid(double base, double step, double duration) noexcept
      : base_(base), step_(step), duration_(duration) {
    assert(step > 0.0 && !(duration < 0.0));
  }

  double step() const noexcept { return step_; }
  /// Number of steps in the duration, including a shorter last one.
  long steps() const noexcept;

  /// The step after those already made.
  PlannedStep next() const noexcept;
  /// A step of size h from the time `now`: the next one if it is of the size of the grid.
  PlannedStep of_size(double h, double now) const noexcept;
  void made(const PlannedStep& step) noexcept;

  double base() const noexcept { return base_; }
  /// Number of steps made since `base`.
  std::int64_t since_base() const noexcept { return since_base_; }
  void restore(double base, std::int64_t since_base) noexcept {
    assert(since_base >= 0);
    base_ = base;
    since_base_ = since_base;
  }

 private:
  /// By which an end of the duration near the end of a step may miss it: a part this short would
  /// be made of rounding [s].
  double slack(double to) const noexcept;

  double base_, step_, duration_;
  std::int64_t since_base_ = 0;
};

}  // namespace floatframe
