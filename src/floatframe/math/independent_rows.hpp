#pragma once
// The independent rows of a sparse matrix in their order, and solutions of least norm. Householder
// QR of the transpose, column by column; only reflections that affect nonzero entries of a column
// are applied. A reflection ends at the coordinate that is used by the following rows for the
// shortest time, so that in a chain of loops each extends only to the next: the cost is
// proportional to their number. Load time.
#include <Eigen/SparseCore>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

using SparseRowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class IndependentRows {
 public:
  /// A row is dependent if less than `threshold` of its length is independent of the rows before
  /// it, or if that part is rounding only.
  IndependentRows(const SparseRowMatrix& A, double threshold);

  Eigen::Index rank() const noexcept { return columns_.size(); }
  /// Ascending.
  const std::vector<int>& dependent() const noexcept { return dependent_; }
  /// The x of least norm that satisfies the independent rows of A x = b.
  VecX least_norm(const VecX& b) const;

 private:
  struct Entry {
    int at;
    double value;
  };
  /// Of an independent row a: H_k ... H_1 a / |a| = R_k + diagonal e_pivot, H_k = I - factor v v^T.
  struct Column {
    int row, pivot;
    double inverse_length;  ///< 1 / |a|
    double diagonal, factor;
    std::vector<Entry> R;  ///< at the pivots of columns before
    std::vector<Entry> v;
  };

  Eigen::Index unknowns_;
  std::vector<Column> columns_;
  std::vector<int> dependent_;

  class Elimination;
};

}  // namespace floatframe
