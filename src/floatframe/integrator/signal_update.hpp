#pragma once
// Signals between elements in the tangent of a step: T + B V^T with the factors of T
// (formulation/signal_tangent.hpp), by Woodbury's formula
//   (T + B V^T)^-1 b = x - W (1 + V^T W)^-1 V^T x,  x = T^-1 b,  W = T^-1 B                    (1)
// and the same for the multipliers. Step time: no heap, noexcept.
#include <Eigen/LU>

#include "floatframe/formulation/equations_of_motion.hpp"

namespace floatframe {

template <EquationsOfMotion F>
class SignalUpdate {
 public:
  /// Allocates.
  explicit SignalUpdate(const F& f)
      : W_(MatX::Zero(f.velocities(), f.signal_rank())),
        V_(W_),
        multipliers_(MatX::Zero(f.constraints(), f.signal_rank())),
        small_(MatX::Identity(f.signal_rank(), f.signal_rank())),
        column_(VecX::Zero(f.velocities())),
        none_(VecX::Zero(f.constraints())),
        mu_(none_),
        part_(VecX::Zero(f.signal_rank())) {
    if (needed()) lu_.compute(small_);
  }

  /// After the factorisation of T in a slot, with the same numbers. False: it is singular.
  bool renew(F& f, double damping, double s, double penalty, int slot) noexcept {
    if (!needed()) return true;
    f.signal_tangent(damping, s, W_, V_);
    for (Eigen::Index j = 0; j < W_.cols(); ++j) {
      column_ = W_.col(j);
      if (none_.size() > 0)
        f.solve(column_, none_, penalty, mu_, slot);
      else
        f.solve(column_, slot);
      W_.col(j) = column_;
      multipliers_.col(j) = mu_;
    }
    small_.noalias() = V_.transpose() * W_;
    small_.diagonal().array() += 1.0;
    lu_.compute(small_);
    return small_.allFinite() && lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0;
  }
  /// (1) of a solution by T.
  void correct(VecX& x) noexcept {
    if (!needed()) return;
    part_.noalias() = V_.transpose() * x;
    scaled_ = lu_.solve(part_);
    x.noalias() -= W_ * scaled_;
  }
  void correct(VecX& x, VecX& mu) noexcept {
    if (!needed()) return;
    correct(x);
    mu.noalias() -= multipliers_ * scaled_;
  }

 private:
  bool needed() const noexcept { return V_.cols() > 0; }

  MatX W_, V_, multipliers_, small_;
  Eigen::PartialPivLU<MatX> lu_;
  VecX column_, none_, mu_, part_, scaled_ = part_;
};

}  // namespace floatframe
