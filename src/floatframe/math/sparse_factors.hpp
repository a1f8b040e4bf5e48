#pragma once
// Factors of a sparse symmetric matrix: A x = b for many right-hand sides. Uses MUMPS (module
// `libfloatframe_mumps.so`, loaded at run time, CeCILL-C) if it was built and is found, else
// Eigen's LDL^T with METIS ordering. Load time: allocates; throws std::runtime_error if memory is
// exhausted.
#include <Eigen/SparseCore>
#include <memory>
#include <string>

#include "floatframe/math/sparse_solver.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

class SparseFactors {
 public:
  /// A: symmetric, both halves stored. `automatic`: MUMPS for large matrices, if available.
  explicit SparseFactors(const Eigen::SparseMatrix<double>& A,
                         SparseSolver solver = SparseSolver::automatic);
  ~SparseFactors();
  SparseFactors(SparseFactors&&) noexcept;
  SparseFactors& operator=(SparseFactors&&) noexcept;

  /// A^-1 B. `singular()` must be -1.
  MatX solve(const MatX& B) const;
  /// A row whose pivot vanishes (against its diagonal entry); -1 if A is regular.
  int singular() const noexcept;
  /// Number of negative pivots: eigenvalues below zero (Sylvester).
  int negative_pivots() const noexcept;
  /// "MUMPS 5.5.0" or "Eigen LDLT, METIS ordering".
  const std::string& name() const noexcept;
  /// Entries of the factor.
  double entries() const noexcept;

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace floatframe
