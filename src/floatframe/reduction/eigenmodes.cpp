#include "floatframe/reduction/eigenmodes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace floatframe {
namespace {

constexpr Eigen::Index dense_limit = 240;

/// Solves the small problem M z = mu K z; mu descending.
void solve_dense(const MatX& M, const MatX& K, VecX& mu, MatX& z) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> solver(M, K);
  mu = solver.eigenvalues().reverse();
  z = solver.eigenvectors().rowwise().reverse();
}

/// Keeps the modes with mass, x^T M x = 1 (x^T K x = 1 on entry), and fixes the signs.
Eigenmodes finish(const VecX& mu, const MatX& shapes, int count) {
  Eigenmodes modes;
  int kept = 0;
  while (kept < count && kept < mu.size() && mu(kept) > 1e-14 * mu(0) && mu(kept) > 0.0) ++kept;
  modes.omega.resize(kept);
  modes.shapes.resize(shapes.rows(), kept);
  for (int i = 0; i < kept; ++i) {
    modes.omega(i) = 1.0 / std::sqrt(mu(i));
    VecX x = shapes.col(i) * modes.omega(i);
    // The first of the components that are largest but for rounding decides the sign.
    const double limit = (1.0 - 1e-6) * x.cwiseAbs().maxCoeff();
    Eigen::Index k = 0;
    while (std::abs(x(k)) < limit) ++k;
    modes.shapes.col(i) = x(k) < 0.0 ? VecX(-x) : x;
  }
  return modes;
}

Eigenmodes subspace_iteration(const SparseMatrix& K, const SparseMatrix& M, int count) {
  const Eigen::Index n = K.rows();
  const Eigen::Index p = std::min<Eigen::Index>(n, 2 * count + 8);
  const Eigen::SimplicialLDLT<SparseMatrix> factors(K);
  MatX X(n, p);
  std::uint64_t random = 88172645463325252ull;  // fixed start: the same modes every time
  for (Eigen::Index j = 0; j < p; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      random ^= random << 13, random ^= random >> 7, random ^= random << 17;
      X(i, j) = static_cast<double>(random >> 11) * 0x1p-53 - 0.5;
    }
  }
  VecX mu, last;
  MatX z;
  int settled = 0;
  for (int iteration = 0; iteration < 300 && settled < 6; ++iteration) {
    MatX MX = M * X;
    MatX Y = factors.solve(MX);
    // K Y = M X, so Y^T K Y = Y^T M X: a product with K would lose the digits of the low modes.
    for (Eigen::Index j = 0; j < p; ++j) {
      const double norm = std::sqrt(std::max(Y.col(j).dot(MX.col(j)), 1e-300));
      Y.col(j) /= norm;
      MX.col(j) /= norm;
    }
    MatX Kr = Y.transpose() * MX;
    MatX Mr = Y.transpose() * (M * Y);
    Kr = 0.5 * (Kr + Kr.transpose()).eval();
    Mr = 0.5 * (Mr + Mr.transpose()).eval();
    // Directions that the subspace does not span any more are dropped.
    const Eigen::SelfAdjointEigenSolver<MatX> basis(Kr);
    Eigen::Index first = 0;
    while (first < p - 1 && basis.eigenvalues()(first) < 1e-13 * basis.eigenvalues()(p - 1))
      ++first;
    const Eigen::Index rank = p - first;
    MatX Q = basis.eigenvectors().rightCols(rank);
    for (Eigen::Index j = 0; j < rank; ++j) Q.col(j) /= std::sqrt(basis.eigenvalues()(first + j));
    const Eigen::SelfAdjointEigenSolver<MatX> ritz(Q.transpose() * Mr * Q);
    mu = ritz.eigenvalues().reverse();
    z = Q * ritz.eigenvectors().rowwise().reverse();
    X.leftCols(rank) = Y * z;
    if (rank < p) X.rightCols(p - rank) = Y.leftCols(p - rank);
    const Eigen::Index used = std::min<Eigen::Index>(count, rank);
    if (last.size() >= used &&
        ((mu.head(used) - last.head(used)).array().abs() <= 1e-11 * mu.head(used).array()).all()) {
      ++settled;
    } else {
      settled = 0;
    }
    last = mu;
  }
  return finish(mu, X.leftCols(mu.size()), count);
}

}  // namespace

Eigenmodes lowest_modes(const SparseMatrix& K, const SparseMatrix& M, int count) {
  if (K.rows() == 0 || count <= 0) return {VecX(), MatX::Zero(K.rows(), 0)};
  if (K.rows() > dense_limit && 4 * count < K.rows()) return subspace_iteration(K, M, count);
  VecX mu;
  MatX z;
  solve_dense(MatX(M), MatX(K), mu, z);
  return finish(mu, z, count);
}

int count_modes_below(const SparseMatrix& K, const SparseMatrix& M, double omega) {
  if (K.rows() == 0) return 0;
  if (K.rows() <= dense_limit) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> solver(MatX(M), MatX(K),
                                                                Eigen::EigenvaluesOnly);
    return static_cast<int>((solver.eigenvalues().array() * omega * omega > 1.0).count());
  }
  const Eigen::SimplicialLDLT<SparseMatrix> factors(SparseMatrix(K - omega * omega * M));
  return static_cast<int>((factors.vectorD().array() < 0.0).count());
}

}  // namespace floatframe
