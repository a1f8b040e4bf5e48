#include "floatframe/reduction/eigenmodes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

constexpr Eigen::Index dense_limit = 240;

/// Solves the small problem M z = mu A z; mu descending.
void solve_dense(const MatX& M, const MatX& A, VecX& mu, MatX& z) {
  const SymmetricEigen pairs = generalised_eigen(M, A);
  mu = pairs.values.reverse();
  z = pairs.vectors.rowwise().reverse();
}

/// Keeps the modes with mass, x^T M x = 1 (x^T A x = 1 on entry), and fixes the signs.
Eigenpairs finish(const VecX& mu, const MatX& shapes, double sigma, int count) {
  Eigenpairs modes;
  int kept = 0;
  while (kept < count && kept < mu.size() && mu(kept) > 1e-14 * mu(0) && mu(kept) > 0.0) ++kept;
  modes.lambda.resize(kept);
  modes.shapes.resize(shapes.rows(), kept);
  for (int i = 0; i < kept; ++i) {
    modes.lambda(i) = sigma + 1.0 / mu(i);
    const VecX x = shapes.col(i) / std::sqrt(mu(i));
    modes.shapes.col(i) = sign_of_largest(x) * x;
  }
  return modes;
}

using Solve = std::function<MatX(const MatX&)>;

/// y = a A^-1 x, without its component along known modes. Scaled so that the largest eigenvalue of
/// A^-1 M is about one: Spectra compares with fixed bounds.
class ShiftInvert {
 public:
  using Scalar = double;
  ShiftInvert(const Solve& solve, Eigen::Index n) : solve_(solve), n_(n) {}
  Eigen::Index rows() const { return n_; }
  Eigen::Index cols() const { return n_; }
  void set_shift(double) const {}
  void perform_op(const double* x, double* y) const {
    Eigen::Map<VecX> out(y, n_);
    out = scale * solve_(Eigen::Map<const VecX>(x, n_));
    if (known.cols() > 0) out -= known * (M_known.transpose() * out);
  }
  double scale = 1.0;
  MatX known, M_known;  ///< x^T M x = 1

 private:
  const Solve& solve_;
  Eigen::Index n_;
};

class MassProduct {
 public:
  using Scalar = double;
  explicit MassProduct(const SparseMatrix& M) : M_(M) {}
  Eigen::Index rows() const { return M_.rows(); }
  Eigen::Index cols() const { return M_.cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<VecX>(y, M_.rows()).noalias() = scale * (M_ * Eigen::Map<const VecX>(x, M_.rows()));
  }
  double scale = 1.0;

 private:
  const SparseMatrix& M_;
};

VecX fixed_start(Eigen::Index n) {
  VecX x(n);
  std::uint64_t random = 88172645463325252ull;
  for (Eigen::Index i = 0; i < n; ++i) {
    random ^= random << 13, random ^= random >> 7, random ^= random << 17;
    x(i) = static_cast<double>(random >> 11) * 0x1p-53 - 0.5;
  }
  return x;
}

using Lanczos =
    Spectra::SymGEigsShiftSolver<ShiftInvert, MassProduct, Spectra::GEigsMode::ShiftInvert>;

/// One block step of inverse iteration from X and a Rayleigh-Ritz projection.
Eigenpairs refined(const Solve& solve, double sigma, const SparseMatrix& M, const MatX& X,
                   int count) {
  // A Y = M X, so Y^T A Y = Y^T M X: a product with K would lose the accuracy of the low modes.
  const MatX MX = M * X;
  MatX Y = solve(MX);
  MatX Ar = Y.transpose() * MX;
  MatX Mr = Y.transpose() * (M * Y);
  Ar = 0.5 * (Ar + Ar.transpose()).eval();
  Mr = 0.5 * (Mr + Mr.transpose()).eval();
  VecX mu;
  MatX z;
  solve_dense(Mr, Ar, mu, z);
  Y = Y * z;
  return finish(mu, Y, sigma, count);
}

/// A Krylov space has one vector per eigenvalue; further modes of equal frequency in symmetric
/// parts appear only by round-off, or not at all. The mode with the largest mu in the complement of
/// the modes found, if it belongs among them; else no column.
MatX missed(ShiftInvert& inverse, MassProduct& mass, const SparseMatrix& M, double sigma,
            const Eigenpairs& found, VecX x) {
  const Eigen::Index n = M.rows(), ncv = std::min<Eigen::Index>(n - found.shapes.cols(), 16);
  if (ncv < 3) return MatX(n, 0);
  inverse.known = found.shapes;
  inverse.M_known = M * found.shapes;
  x -= inverse.known * (inverse.M_known.transpose() * x);
  Lanczos solver(inverse, mass, 1, ncv, 0.0);
  solver.init(x.data());
  solver.compute(Spectra::SortRule::LargestMagn, 40, 1e-6, Spectra::SortRule::SmallestAlge);
  MatX one = solver.eigenvectors();
  if (one.cols() == 0) return one;
  one -= inverse.known * (inverse.M_known.transpose() * one);
  const VecX Mx = M * one.col(0);
  const double size = one.col(0).dot(Mx);
  if (!(size > 0.0)) return MatX(n, 0);
  VecX y(n);  // mu = x^T M A^-1 M x / x^T M x
  inverse.perform_op(Mx.data(), y.data());
  const double mu = Mx.dot(y) / (inverse.scale * size);
  const double least = 1.0 / (found.lambda(found.lambda.size() - 1) - sigma);
  return mu > (1.0 + 1e-6) * least ? one : MatX(n, 0);
}

Eigenpairs iterated(const Solve& solve, double sigma, const SparseMatrix& M, int count) {
  const Eigen::Index n = M.rows();
  ShiftInvert inverse(solve, n);
  MassProduct mass(M);
  const double mean = M.diagonal().sum() / static_cast<double>(n);
  if (!(mean > 0.0)) return {VecX(), MatX::Zero(n, 0)};
  mass.scale = 1.0 / mean;
  VecX x = fixed_start(n), y;
  for (int step = 0; step < 2; ++step) {
    y = solve(MatX(mass.scale * (M * x)));
    const double before = std::sqrt(std::max(x.dot(M * x), 0.0));
    const double after = std::sqrt(std::max(y.dot(M * y), 0.0));
    if (!(after > 0.0) || !std::isfinite(after)) return {VecX(), MatX::Zero(n, 0)};
    inverse.scale = before / after;
    x = y / after;
  }
  const Eigen::Index ncv = std::min<Eigen::Index>(n, std::max(2 * count + 8, 24));
  Lanczos solver(inverse, mass, count, ncv, 0.0);
  solver.init(x.data());
  solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-11, Spectra::SortRule::SmallestAlge);
  MatX found = solver.eigenvectors();
  if (found.cols() == 0) return {VecX(), MatX::Zero(n, 0)};
  Eigenpairs modes = refined(solve, sigma, M, found, count);
  for (int k = 0; k < count && modes.lambda.size() > 0; ++k) {
    const MatX one = missed(inverse, mass, M, sigma, modes, fixed_start(n));
    if (one.cols() == 0) break;
    found.resize(n, modes.shapes.cols() + 1);
    found << modes.shapes, one;
    modes = refined(solve, sigma, M, found, count);
  }
  return modes;
}

/// The same, with exceptions of Spectra replaced by messages for the user.
Eigenpairs lanczos(const Solve& solve, double sigma, const SparseMatrix& M, int count) {
  try {
    return iterated(solve, sigma, M, count);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw EigenIterationError(
        ErrorCode::no_convergence,
        fmt::format("the iteration for the {} lowest modes fails: equal parts have equal "
                    "frequencies, and directions without mass leave nothing to tell their modes "
                    "apart; take fewer normal modes",
                    count));
  }
}

}  // namespace

double sign_of_largest(const VecX& x) {
  const double limit = (1.0 - 1e-6) * x.cwiseAbs().maxCoeff();
  Eigen::Index k = 0;
  while (std::abs(x(k)) < limit) ++k;
  return x(k) < 0.0 ? -1.0 : 1.0;
}

Eigenpairs lowest_eigenpairs(const SparseMatrix& A, const SparseFactors& factors, double sigma,
                             const SparseMatrix& M, int count) {
  const Eigen::Index n = A.rows();
  if (n == 0 || count <= 0) return {VecX(), MatX::Zero(n, 0)};
  count = static_cast<int>(std::min<Eigen::Index>(count, n));
  if (n > dense_limit && (4 * count < n || n > 10 * dense_limit) && count < n) try {
      return lanczos([&](const MatX& b) { return factors.solve(b); }, sigma, M, count);
    } catch (const EigenIterationError&) {
      if (n > 10 * dense_limit) throw;  // minutes
    }
  VecX mu;
  MatX z;
  solve_dense(MatX(M), MatX(A), mu, z);
  return finish(mu, z, sigma, count);
}

Eigenmodes lowest_modes(const SparseMatrix& K, const SparseFactors& factors, const SparseMatrix& M,
                        int count) {
  Eigenpairs pairs = lowest_eigenpairs(K, factors, 0.0, M, count);
  return {pairs.lambda.cwiseMax(0.0).cwiseSqrt(), std::move(pairs.shapes)};
}

Eigenmodes lowest_modes(const Solve& solve, const SparseMatrix& M, int count) {
  if (M.rows() == 0 || count <= 0) return {VecX(), MatX::Zero(M.rows(), 0)};
  Eigenpairs pairs =
      lanczos(solve, 0.0, M, static_cast<int>(std::min<Eigen::Index>(count, M.rows() - 1)));
  return {pairs.lambda.cwiseMax(0.0).cwiseSqrt(), std::move(pairs.shapes)};
}

Eigenmodes lowest_modes(const SparseMatrix& K, const SparseMatrix& M, int count) {
  if (K.rows() == 0 || count <= 0) return {VecX(), MatX::Zero(K.rows(), 0)};
  return lowest_modes(K, SparseFactors(K), M, count);
}

int count_modes_below(const SparseMatrix& K, const SparseMatrix& M, double omega,
                      SparseSolver solver) {
  if (K.rows() == 0) return 0;
  if (K.rows() <= dense_limit) {
    const VecX mu = generalised_eigenvalues(MatX(M), MatX(K)).values;
    return static_cast<int>((mu.array() * omega * omega > 1.0).count());
  }
  return SparseFactors(SparseMatrix(K - omega * omega * M), solver).negative_pivots();
}

}  // namespace floatframe
