#pragma once
// Modes of turning rotors beside those of small systems of equations.
#include <algorithm>

#include "floatframe/math/dense.hpp"
#include "floatframe/rotors/turning_model.hpp"

namespace floatframe::test {

/// Largest relative distance of the eigenvalues of m x'' + C x' + K x = 0 from the modes found, of
/// which one stands for a pair.
inline double distance_of_modes(const VecX& m, const MatX& C, const MatX& K,
                                const std::vector<TurningMode>& found) {
  const Eigen::Index n = m.size();
  MatX A = MatX::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = m.cwiseInverse().asDiagonal() * -K;
  A.bottomRightCorner(n, n) = m.cwiseInverse().asDiagonal() * -C;
  double worst = 0.0;
  for (const std::complex<double>& e : general_eigen(A).values) {
    double best = 1e300;
    for (const TurningMode& f : found)
      best = std::min({best, std::abs(f.lambda - e), std::abs(std::conj(f.lambda) - e)});
    worst = std::max(worst, best / std::abs(e));
  }
  return worst;
}

}  // namespace floatframe::test
