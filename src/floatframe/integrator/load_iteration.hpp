#pragma once
// Friction from the reactions of joints: the loads N that elements read follow the iterate,
//   N = L(a, lambda, N),                                                                      (1)
// with the reactions of accelerations and multipliers that satisfy the constraints at the positions
// and velocities of the iterate. Those of the iterate itself do not: with x from positions alone,
// the trapezoidal rule has a third of h da/dt as error across the constraints, and friction would
// make the scheme one of first order. A pass
//   T0 da + Phi_q^T (p mu) = 0,  Phi_q da - mu = -(Phi_q (a + da_0) - gamma)                  (2)
// of each iteration corrects both, with the factors at hand: da = da_0 + da, lambda += p mu. The
// first iteration has no factors and is not the last one.
//
// The tangent leaves out dL/dN. Each load is iterated by the secant of its last two gaps
// g = L - N,
//   N += g / (1 - c),  c = 1 + (g - g_before) / (N - N_before),                               (3)
// where c is the contraction of N = L(N): loads that friction lowers have c < 0, c = 1 is a
// mechanism that jams, however large its driving force. Step time: no heap, noexcept.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// f: a formulation.
class LoadIteration {
 public:
  /// Newton iterations of a step with loads.
  static constexpr int least_iterations = 3;

  /// Allocates.
  explicit LoadIteration(const auto& f) {
    const int n = f.load_count();
    loads_ = found_ = gap_ = change_ = c_ = VecX::Zero(n);
    if (n == 0) return;
    a_ = da_ = delta_ = VecX::Zero(f.velocities());
    lambda_ = dlambda_ = rate_ = mu_ = VecX::Zero(f.constraints());
  }
  bool needed() const noexcept { return loads_.size() > 0; }

  /// At the beginning of a step.
  void begin() noexcept {
    passes_ = 0;
    contraction_ = 0.0;
    c_.setZero();
    da_.setZero();
    dlambda_.setZero();
  }
  /// The efforts of the elements at an iterate, after `dynamics`; with p, and the slot of the
  /// factors of (2); -1: none.
  void follow(auto& f, const VecX& a, const VecX& lambda, double penalty, int slot) noexcept {
    assert(needed() && a.size() == a_.size() && lambda.size() == lambda_.size());
    a_ = a + da_;
    if (slot >= 0 && rate_.size() > 0) {  // (2)
      f.constraint_accelerations(a_, rate_);
      delta_.setZero();
      f.solve(delta_, rate_, penalty, mu_, slot);
      a_ += delta_;
      da_ += delta_;
      dlambda_ += penalty * mu_;
    }
    lambda_ = lambda + dlambda_;
    iterate(f, a_, lambda_);
  }
  /// The same for a and lambda that satisfy the constraints.
  void iterate(auto& f, const VecX& a, const VecX& lambda) noexcept {
    f.loads(loads_);
    f.find_loads(a, lambda, found_);
    const double size = std::max(found_.cwiseAbs().maxCoeff(), loads_.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < loads_.size(); ++i) {
      const double gap = found_[i] - loads_[i];
      // The first two gaps are those of the predictor and of the constraints.
      if (passes_ > 1 && std::abs(change_[i]) > negligible * size) {
        const double c = 1.0 + (gap - gap_[i]) / change_[i];
        c_[i] = std::clamp(c, least_c, most_c);
        if (std::abs(change_[i]) > measurable * size)
          contraction_ = std::max(contraction_, std::abs(c));
      }
      change_[i] = gap / (1.0 - c_[i]);  // (3)
      gap_[i] = gap;
      loads_[i] = std::max(0.0, loads_[i] + change_[i]);
    }
    ++passes_;
    f.set_loads(loads_);
  }
  /// The last one of a load, relative to the largest load.
  double change() const noexcept {
    const double size = loads_.cwiseAbs().maxCoeff();
    return size > 0.0 ? change_.cwiseAbs().maxCoeff() / size : 0.0;
  }
  /// The largest |c| of the step.
  double contraction() const noexcept { return contraction_; }

 private:
  /// Changes of loads relative to the largest one: those that may be rounding, for which c is the
  /// last one; and those that show the contraction.
  static constexpr double negligible = 1e-5, measurable = 1e-3;
  static constexpr double least_c = -30.0, most_c = 0.9;

  VecX loads_, found_, gap_, change_, c_;
  VecX a_, da_, delta_, lambda_, dlambda_, rate_, mu_;
  int passes_ = 0;
  double contraction_ = 0.0;
};

}  // namespace floatframe
