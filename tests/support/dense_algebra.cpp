#include "support/dense_algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace floatframe::test {

VecX eigenvalues(const MatX& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatX>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

VecX eigenvalues(const MatX& K, const MatX& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
}

VecX lowest_eigenvector(const MatX& K, const MatX& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(K, M).eigenvectors().col(0);
}

MatX least_squares(const MatX& A, const MatX& b) { return A.colPivHouseholderQr().solve(b); }

VecX singular_values(const MatX& A) { return Eigen::JacobiSVD<MatX>(A).singularValues(); }

}  // namespace floatframe::test
