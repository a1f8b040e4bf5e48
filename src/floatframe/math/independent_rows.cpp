#include "floatframe/math/independent_rows.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>
#include <algorithm>

namespace floatframe {

struct IndependentRows::Factors {
  VecX inverse_length;  ///< of each row, 0 for empty ones
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::NaturalOrdering<int>> qr;
};

IndependentRows::IndependentRows(const SparseRowMatrix& A, double threshold)
    : factors_(std::make_unique<Factors>()) {
  Eigen::SparseMatrix<double> columns = A.transpose();
  VecX& inverse = factors_->inverse_length;
  inverse = VecX::Zero(A.rows());
  for (int i = 0; i < columns.outerSize(); ++i) {
    const double length = columns.col(i).norm();
    if (!(length > 0.0)) continue;
    inverse[i] = 1.0 / length;
    columns.col(i) *= inverse[i];
  }
  columns.makeCompressed();
  factors_->qr.setPivotThreshold(threshold);
  factors_->qr.compute(columns);
}

IndependentRows::~IndependentRows() = default;
IndependentRows::IndependentRows(IndependentRows&&) noexcept = default;
IndependentRows& IndependentRows::operator=(IndependentRows&&) noexcept = default;

Eigen::Index IndependentRows::rank() const { return factors_->qr.rank(); }

std::vector<int> IndependentRows::dependent() const {
  const auto& order = factors_->qr.colsPermutation().indices();
  std::vector<int> rows(order.data() + rank(), order.data() + order.size());
  std::sort(rows.begin(), rows.end());
  return rows;
}

VecX IndependentRows::least_norm(const VecX& b) const {
  const auto& qr = factors_->qr;
  const Eigen::Index r = rank();
  const auto& order = qr.colsPermutation().indices();
  // A^T P = Q R with the independent rows first: R11^T z = P^T b, x = Q z.
  VecX z = VecX::Zero(qr.rows());
  for (Eigen::Index k = 0; k < r; ++k) z[k] = b[order[k]] * factors_->inverse_length[order[k]];
  const Eigen::SparseMatrix<double> R =
      Eigen::SparseMatrix<double>(qr.matrixR()).topLeftCorner(r, r);
  VecX head = z.head(r);
  R.transpose().triangularView<Eigen::Lower>().solveInPlace(head);
  z.head(r) = head;
  return qr.matrixQ() * z;
}

}  // namespace floatframe
