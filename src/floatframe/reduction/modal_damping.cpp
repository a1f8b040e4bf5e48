#include "floatframe/reduction/modal_damping.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

MatX modal_damping(const MatX& K, const MatX& M, double ratio) {
  MatX D = MatX::Zero(K.rows(), K.cols());
  if (ratio == 0.0 || K.rows() == 0) return D;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> solver(M, K);
  if (solver.info() != Eigen::Success) {
    throw InputError("modal damping needs a positive definite modal stiffness");
  }
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    const double mu = solver.eigenvalues()(i);
    if (!(mu > 1e-14 * solver.eigenvalues()(K.rows() - 1))) continue;
    const VecX Kx = K * solver.eigenvectors().col(i);
    D += 2.0 * ratio * std::sqrt(mu) * Kx * Kx.transpose();
  }
  return 0.5 * (D + D.transpose());
}

}  // namespace floatframe
