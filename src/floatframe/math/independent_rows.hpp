#pragma once
// The rows of a sparse matrix in their order: which repeat those before them, and solutions of
// least norm. Sparse QR of the transpose without a change of the order, so that rows that are
// listed from neighbour to neighbour (chains, ladders, vehicles one after the other) cost in
// proportion to their number. Load time.
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
