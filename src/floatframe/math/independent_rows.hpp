#pragma once
// The rows of a sparse matrix in their order: which depend on those before them, and solutions of
// least norm. Sparse QR of the transpose in natural ordering, which keeps the order of the rows.
// Each dependent row costs a new elimination tree. Load time.
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

using SparseRowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class IndependentRows {
 public:
  /// A row is dependent if less than `threshold` of its length is left beside the rows before it.
  IndependentRows(const SparseRowMatrix& A, double threshold);
  ~IndependentRows();
  IndependentRows(IndependentRows&&) noexcept;
  IndependentRows& operator=(IndependentRows&&) noexcept;

  Eigen::Index rank() const;
  /// Ascending.
  std::vector<int> dependent() const;
  /// The x of least norm that meets the independent rows of A x = b.
  VecX least_norm(const VecX& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace floatframe
