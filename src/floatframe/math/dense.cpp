#include "floatframe/math/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cassert>
#include <limits>

#include "floatframe/math/balancing.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {
namespace {

template <typename Decomposition>
Decomposition decomposed(const MatX& A, std::optional<double> threshold) {
  Decomposition d;
  if (threshold) d.setThreshold(*threshold);
  d.compute(A);
  return d;
}

/// For a problem without a solution: NaN, which compares false with every value.
SymmetricEigen not_found(Eigen::Index n, Eigen::Index vectors) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {VecX::Constant(n, nan), MatX::Constant(n, vectors, nan), false};
}

using ColPivQr = Eigen::ColPivHouseholderQR<MatX>;

}  // namespace

SymmetricEigen symmetric_eigen(const MatX& A) {
  assert(A.rows() == A.cols());
  const Eigen::SelfAdjointEigenSolver<MatX> solver(A);
  if (solver.info() != Eigen::Success) return not_found(A.rows(), A.rows());
  return {solver.eigenvalues(), solver.eigenvectors(), true};
}

VecX symmetric_eigenvalues(const MatX& A) {
  assert(A.rows() == A.cols());
  const Eigen::SelfAdjointEigenSolver<MatX> solver(A, Eigen::EigenvaluesOnly);
  return solver.info() == Eigen::Success ? solver.eigenvalues() : not_found(A.rows(), 0).values;
}

SymmetricEigen generalised_eigen(const MatX& A, const MatX& B) {
  assert(A.rows() == A.cols() && A.rows() == B.rows());
  // Eigen continues with the remains of a failed Cholesky factor.
  if (!is_positive_definite(B)) return not_found(A.rows(), A.rows());
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> solver(A, B);
  if (solver.info() != Eigen::Success) return not_found(A.rows(), A.rows());
  return {solver.eigenvalues(), solver.eigenvectors(), true};
}

SymmetricEigen generalised_eigenvalues(const MatX& A, const MatX& B) {
  assert(A.rows() == A.cols() && A.rows() == B.rows());
  if (!is_positive_definite(B)) return not_found(A.rows(), 0);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> solver(A, B, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return not_found(A.rows(), 0);
  return {solver.eigenvalues(), MatX(), true};
}

GeneralEigen general_eigen(const MatX& A) {
  const Eigen::Index n = A.rows();
  assert(A.cols() == n);
  if (n == 0) return {Eigen::VectorXcd(0), Eigen::MatrixXcd(0, 0), true};
  MatX B = A;
  const VecX d = balance(B);
  const Eigen::EigenSolver<MatX> solver(B);
  if (solver.info() != Eigen::Success) return {};
  GeneralEigen e{solver.eigenvalues(), solver.eigenvectors(), true};
  e.vectors = (d.cast<std::complex<double>>().asDiagonal() * e.vectors).eval();
  e.vectors.colwise().normalize();
  return e;
}

bool is_positive_definite(const MatX& A) {
  assert(A.rows() == A.cols());
  return Eigen::LLT<MatX>(A).info() == Eigen::Success;
}

PivotedQr pivoted_qr(const MatX& A, std::optional<double> threshold) {
  const auto qr = decomposed<ColPivQr>(A, threshold);
  return {qr.rank(), qr.householderQ(), qr.matrixR().diagonal(), qr.colsPermutation().indices()};
}

Eigen::Index pivoted_rank(const MatX& A, std::optional<double> threshold) {
  if (A.size() == 0) return 0;
  return decomposed<ColPivQr>(A, threshold).rank();
}

Orthonormal orthonormal_columns(const MatX& A) {
  const Eigen::Index n = A.cols();
  assert(A.rows() >= n);
  const Eigen::HouseholderQR<MatX> qr(A);
  const MatX R = qr.matrixQR().topRows(n);
  return {qr.householderQ() * MatX::Identity(A.rows(), n),
          R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n))};
}

Singular singular_values(const MatX& A) {
  const Eigen::JacobiSVD<MatX> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

/// Eigen's decomposition cannot be applied to a matrix without rows or columns, whose solution is
/// zero.
struct LeastNorm::Factors {
  Eigen::Index rows = 0, cols = 0;
  std::optional<Eigen::CompleteOrthogonalDecomposition<MatX>> cod;
};

LeastNorm::LeastNorm(const MatX& A, std::optional<double> threshold)
    : factors_(new Factors{A.rows(), A.cols(), std::nullopt}) {
  if (A.size() > 0)
    factors_->cod = decomposed<Eigen::CompleteOrthogonalDecomposition<MatX>>(A, threshold);
}
LeastNorm::~LeastNorm() = default;
LeastNorm::LeastNorm(LeastNorm&&) noexcept = default;
LeastNorm& LeastNorm::operator=(LeastNorm&&) noexcept = default;

VecX LeastNorm::solve(const VecX& b) const {
  assert(b.size() == factors_->rows);
  if (!factors_->cod) return VecX::Zero(factors_->cols);
  return factors_->cod->solve(b);
}
MatX LeastNorm::solve(const MatX& B) const {
  assert(B.rows() == factors_->rows);
  if (!factors_->cod) return MatX::Zero(factors_->cols, B.cols());
  return factors_->cod->solve(B);
}
MatX LeastNorm::pseudo_inverse() const {
  if (!factors_->cod) return MatX::Zero(factors_->cols, factors_->rows);
  return factors_->cod->pseudoInverse();
}

MatX lu_solve(const MatX& A, const MatX& B) {
  assert(A.rows() == A.cols() && A.rows() == B.rows());
  return A.partialPivLu().solve(B);
}
MatX ldlt_solve(const MatX& A, const MatX& B) {
  assert(is_symmetric(A) && A.rows() == B.rows());
  return A.ldlt().solve(B);
}
MatX qr_solve(const MatX& A, const MatX& B) {
  assert(A.rows() == B.rows());
  return A.colPivHouseholderQr().solve(B);
}

double largest(const VecX& x) { return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>(); }

}  // namespace floatframe
