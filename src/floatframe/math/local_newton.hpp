#pragma once
// Damped Newton iteration for a few unknowns inside a step, gap(y) = 0. An increment is shortened
// until the next one, with the same slopes, is smaller in sizes that the unknowns have had; the
// error after an increment below 1e-7 is its square. Step time: no heap, noexcept.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe {

class LocalNewton {
 public:
  /// With n unknowns. Allocates.
  explicit LocalNewton(Eigen::Index n)
      : slopes(MatX::Identity(n, n)),
        gap(VecX::Zero(n)),
        size(gap),
        start_(gap),
        step_(gap),
        next_(gap) {
    if (n > 0) lu_.compute(slopes);
  }

  MatX slopes;  ///< d(gap)/dy
  VecX gap;
  VecX size;  ///< the largest magnitude of each unknown, or what it is compared with

  /// `evaluate()` fills gap at y and lets size grow; then `find_slopes()` fills slopes. False:
  /// there is no solution near y.
  template <class Unknowns, class Evaluate, class FindSlopes>
  bool solve(Unknowns& y, const Evaluate& evaluate, const FindSlopes& find_slopes) noexcept {
    constexpr int most_iterations = 50;
    constexpr double rounding = 1e-14, last = 1e-7;
    size.setZero();
    evaluate();
    for (int k = 0; k < most_iterations; ++k) {
      find_slopes();
      lu_.compute(slopes);
      step_ = lu_.solve(gap);
      if (!step_.allFinite()) return false;
      const double length = relative_size(step_);
      if (length <= rounding) return true;
      if (length <= last) {
        y -= step_;
        evaluate();
        return true;
      }
      if (!shortened_step(y, evaluate)) return false;
    }
    return false;
  }

 private:
  double relative_size(const VecX& x) const noexcept {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double part = std::abs(x[i]);
      if (std::isnan(part)) return part;
      if (part > 0.0) largest = std::max(largest, part / std::max(size[i], 1e-300));
    }
    return largest;
  }

  template <class Unknowns, class Evaluate>
  bool shortened_step(Unknowns& y, const Evaluate& evaluate) noexcept {
    constexpr double least_part = 1e-4;
    start_ = y;
    const double before = relative_size(step_);
    for (double part = 1.0; part > least_part; part *= 0.5) {
      y = start_ - part * step_;
      evaluate();
      next_ = lu_.solve(gap);
      if (relative_size(next_) <= (1.0 - 0.25 * part) * before) return true;
    }
    return false;
  }

  Eigen::PartialPivLU<MatX> lu_;
  VecX start_, step_, next_;
};

}  // namespace floatframe
