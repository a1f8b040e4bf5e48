// The engine that needs only Eigen: simplicial LDL^T, the matrix permuted beforehand.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "floatframe/math/sparse_engine.hpp"

namespace floatframe {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class EigenEngine final : public SparseEngine {
 public:
  explicit EigenEngine(const LowerTriangle& A) : order_(A.order, A.order + A.n) {
    Eigen::SparseMatrix<double> permuted(A.n, A.n);
    permute(A, permuted);
    Factors factors(permuted);
    L_ = factors.matrixL().nestedExpression();
    D_ = factors.vectorD();
    name = "Eigen LDLT, METIS ordering";
    entries = static_cast<double>(L_.nonZeros());
    for (int k = 0; k < A.n; ++k) {
      // The factorisation stops at the first pivot that is exactly zero; those before it are valid.
      if (!(std::abs(D_(k)) > vanishing_pivot)) {
        singular = static_cast<int>(std::find(order_.begin(), order_.end(), k) - order_.begin());
        return;
      }
      if (D_(k) < 0.0) ++negative_pivots;
    }
  }

  void solve(double* B, int columns) const override {
    constexpr int width = 8;  // columns at once: L is read once for all
    const Eigen::Index n = D_.size();
    Eigen::Map<MatX> all(B, n, columns);
    Rows x(n, std::min(width, columns));
    for (int first = 0; first < columns; first += width) {
      const int count = std::min(width, columns - first);
      if (count < x.cols()) x.resize(n, count);
      for (Eigen::Index k = 0; k < n; ++k) x.row(order_[k]) = all.block(k, first, 1, count);
      if (count == width) {
        substitute<width>(x);
      } else if (count == 1) {
        substitute<1>(x);
      } else {
        substitute<Eigen::Dynamic>(x);
      }
      for (Eigen::Index k = 0; k < n; ++k) all.block(k, first, 1, count) = x.row(order_[k]);
    }
  }

 private:
  using Factors =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  /// Lower triangle of P A P^T.
  void permute(const LowerTriangle& A, Eigen::SparseMatrix<double>& out) const {
    std::vector<Eigen::Triplet<double>> entry;
    entry.reserve(A.start[A.n]);
    for (int j = 0; j < A.n; ++j) {
      for (int k = A.start[j]; k < A.start[j + 1]; ++k) {
        const int r = order_[A.row[k]];
        const int c = order_[j];
        entry.emplace_back(std::max(r, c), std::min(r, c), A.value[k]);
      }
    }
    out.setFromTriplets(entry.begin(), entry.end());
  }

  /// L D L^T x = b in place, one row of x per row of the matrix.
  template <int Width>
  void substitute(Rows& x) const {
    const Eigen::Index width = Width == Eigen::Dynamic ? x.cols() : Width;
    using Row = Eigen::Map<Eigen::Matrix<double, 1, Width, Eigen::RowMajor>>;
    const auto row = [&](Eigen::Index k) { return Row(x.data() + k * width, 1, width); };
    for (int j = 0; j < L_.cols(); ++j) {
      const Row xj = row(j);
      for (Eigen::SparseMatrix<double>::InnerIterator it(L_, j); it; ++it)
        if (it.row() > j) row(it.row()) -= it.value() * xj;
    }
    for (int j = static_cast<int>(L_.cols()) - 1; j >= 0; --j) {
      Row xj = row(j);
      xj /= D_(j);
      for (Eigen::SparseMatrix<double>::InnerIterator it(L_, j); it; ++it)
        if (it.row() > j) xj -= it.value() * row(it.row());
    }
  }

  std::vector<int> order_;
  Eigen::SparseMatrix<double> L_;
  VecX D_;
};

}  // namespace

std::unique_ptr<SparseEngine> eigen_engine(const LowerTriangle& A) {
  return std::make_unique<EigenEngine>(A);
}

}  // namespace floatframe
