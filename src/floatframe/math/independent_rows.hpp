#pragma once
// The rows of a sparse matrix in their order: which depend on those before them, and solutions of
// least norm. Householder QR of the transpose, a column at a time, which takes up only the
// reflections that reach what is not zero in it. A reflection ends at the coordinate that the rows
// to come use for the shortest time, so that those of a chain of loops reach from one to the next:
// the cost is proportional to their number. Load time.
#include <Eigen/SparseCore>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

using SparseRowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class IndependentRows {
 public:
  /// A row is dependent if less than `threshold` of its length is left beside the rows before it,
  /// or if it is nothing but rounding.
  IndependentRows(const SparseRowMatrix& A, double threshold);

  Eigen::Index rank() const noexcept { return columns_.size(); }
  /// Ascending.
  const std::vector<int>& dependent() const noexcept { return dependent_; }
  /// The x of least norm that meets the independent rows of A x = b.
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
