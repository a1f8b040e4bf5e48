#pragma once
// Scales d, powers of two, for which rows and columns of D^-1 A D, D = diag(d), are of similar
// size: orthogonal decompositions then keep the digits of entries that are small due to their unit.
#include "floatframe/math/types.hpp"

namespace floatframe {

/// A becomes D^-1 A D.
inline VecX balance(MatX& A) {
  const Eigen::Index n = A.rows();
  VecX d = VecX::Ones(n);
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double row = A.row(i).cwiseAbs().sum() - std::abs(A(i, i));
      double column = A.col(i).cwiseAbs().sum() - std::abs(A(i, i));
      if (!(row > 0.0 && column > 0.0 && row < 1e300 && column < 1e300)) continue;
      const double sum = row + column;
      double f = 1.0;
      while (column < 0.5 * row) column *= 4.0, f *= 2.0;
      while (column >= 2.0 * row) column /= 4.0, f /= 2.0;
      if ((row / 1.0 + column) / f >= 0.95 * sum) continue;
      changed = true;
      d[i] *= f;
      A.col(i) *= f;
      A.row(i) /= f;
    }
  }
  return d;
}

}  // namespace floatframe
