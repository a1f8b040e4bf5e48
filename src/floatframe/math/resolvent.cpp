#include "floatframe/math/resolvent.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "floatframe/math/balancing.hpp"

namespace floatframe {

Resolvent::Resolvent(const MatX& A) : H_(A) {
  scales_ = balance(H_);
  Q_ = MatX::Identity(A.rows(), A.rows());
  if (A.rows() < 3) return;  // it is Hessenberg
  const Eigen::HessenbergDecomposition<MatX> decomposition(H_);
  Q_ = decomposition.matrixQ();
  H_ = decomposition.matrixH();
}

bool Resolvent::solve(std::complex<double> s, const Eigen::MatrixXcd& B,
                      Eigen::MatrixXcd& X) const {
  const Eigen::Index n = H_.rows();
  Eigen::MatrixXcd T = -H_.cast<std::complex<double>>();
  T.diagonal().array() += s;
  Eigen::MatrixXcd Y = Q_.transpose() * (scales_.cwiseInverse().asDiagonal() * B);
  const double smallest =
      std::numeric_limits<double>::min() + 1e-15 * (n > 0 ? T.cwiseAbs().maxCoeff() : 0.0);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k + 1 < n) {
      const Eigen::Index rest = n - k;
      if (std::abs(T(k + 1, k)) > std::abs(T(k, k))) {
        T.row(k).tail(rest).swap(T.row(k + 1).tail(rest));
        Y.row(k).swap(Y.row(k + 1));
      }
      if (!(std::abs(T(k, k)) > smallest)) return false;
      const std::complex<double> factor = T(k + 1, k) / T(k, k);
      T.row(k + 1).tail(rest) -= factor * T.row(k).tail(rest);
      Y.row(k + 1) -= factor * Y.row(k);
    } else if (!(std::abs(T(k, k)) > smallest)) {
      return false;
    }
  }
  T.triangularView<Eigen::Upper>().solveInPlace(Y);
  X = scales_.asDiagonal() * (Q_ * Y);
  return true;
}

}  // namespace floatframe
