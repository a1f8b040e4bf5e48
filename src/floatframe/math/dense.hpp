#pragma once

#include <complex>
#include <memory>
#include <optional>

#include "floatframe/math/types.hpp"

/// Decompositions of dense matrices of any size, for computations at load time or at the start.
///
/// They are compiled here and nowhere else: each of Eigen's decompositions costs every source that
/// names it 4 to 8 s of compile time.

namespace floatframe {

/// Eigenvalues in ascending order and their vectors, one per column (empty if only values were
/// requested).
struct SymmetricEigen {
  VecX values;
  MatX vectors;
  bool found = false;  ///< false: B is not positive definite, or no convergence; all NaN then
};

/// A x = lambda x of a symmetric matrix, of which the lower triangle is used; |x| = 1.
SymmetricEigen symmetric_eigen(const MatX& A);
VecX symmetric_eigenvalues(const MatX& A);

/// A x = lambda B x, A symmetric, B symmetric and positive definite (lower triangles); x^T B x = 1.
SymmetricEigen generalised_eigen(const MatX& A, const MatX& B);
/// The same without vectors.
SymmetricEigen generalised_eigenvalues(const MatX& A, const MatX& B);

/// A x = lambda x of any real square matrix, |x| = 1; complex pairs are consecutive. Rows and
/// columns are scaled before (balancing): coordinates may have different magnitudes.
struct GeneralEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  bool found = false;
};
GeneralEigen general_eigen(const MatX& A);

bool is_positive_definite(const MatX& A);

/// A P = Q R with column pivoting: the leading `rank` columns of Q span the columns of A, the
/// others the orthogonal complement.
struct PivotedQr {
  Eigen::Index rank = 0;
  MatX Q;                  ///< rows x rows
  VecX diagonal;           ///< of R, magnitudes not increasing
  Eigen::VectorXi pivots;  ///< column of A at each place
};

/// `threshold`: below it diagonal entries of R count as zero, relative to the largest one; by
/// default the rounding of double precision times the size.
PivotedQr pivoted_qr(const MatX& A, std::optional<double> threshold = {});
Eigen::Index pivoted_rank(const MatX& A, std::optional<double> threshold = {});

/// Q = A W with orthonormal columns, as many as in A, which must be independent.
struct Orthonormal {
  MatX Q, W;
};
Orthonormal orthonormal_columns(const MatX& A);

/// Singular values in descending order and the right vectors, all columns of V.
struct Singular {
  VecX values;
  MatX V;
};
Singular singular_values(const MatX& A);

/// The solutions x of least norm of min |A x - b| (complete orthogonal decomposition), factorised
/// once. `threshold` as in pivoted_qr().
class LeastNorm {
 public:
  explicit LeastNorm(const MatX& A, std::optional<double> threshold = {});
  ~LeastNorm();
  LeastNorm(LeastNorm&&) noexcept;
  LeastNorm& operator=(LeastNorm&&) noexcept;

  VecX solve(const VecX& b) const;
  MatX solve(const MatX& B) const;
  MatX pseudo_inverse() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// Solutions of A X = B for a regular A: by LU with partial pivoting, by LDLT for a symmetric
/// semidefinite A, by QR with column pivoting.
MatX lu_solve(const MatX& A, const MatX& B);
MatX ldlt_solve(const MatX& A, const MatX& B);
MatX qr_solve(const MatX& A, const MatX& B);

/// The largest magnitude in x; 0 if x is empty.
double largest(const VecX& x);

}  // namespace floatframe
