#include "floatframe/fe/pair_products.hpp"

#include <utility>

namespace floatframe {
namespace {

/// Points whose products are collected for one dense product.
constexpr Eigen::Index batch = 48;

/// Six columns (xx, yy, zz, xy, yz, zx) of all pairs.
void products(const MatX& g, Eigen::Ref<MatX> P) {
  constexpr int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  const MatX rows = g.transpose();  // entries of one mode are contiguous
  const Eigen::Index fields = g.rows() / 3;
  for (int c = 0; c < 6; ++c) {
    const int j = at[c][0], k = at[c][1];
    double* column = P.col(c).data();
    for (Eigen::Index a = 0; a < rows.rows(); ++a) {
      Eigen::Map<VecX> to(column, a + 1);
      to = rows(a, j) * rows.col(k).head(a + 1);
      for (Eigen::Index i = 1; i < fields; ++i)
        to += rows(a, 3 * i + j) * rows.col(3 * i + k).head(a + 1);
      for (Eigen::Index i = 0; j != k && i < fields; ++i)
        to += rows(a, 3 * i + k) * rows.col(3 * i + j).head(a + 1);
      column += a + 1;
    }
  }
}

}  // namespace

PairProducts::PairProducts(Eigen::Index modes, Eigen::Index cases)
    : K_(MatX::Zero(modes * (modes + 1) / 2, cases)),
      P_(modes * (modes + 1) / 2, 6 * batch),
      S_(cases, 6 * batch) {}

void PairProducts::add(const MatX& g, const MatX& s) {
  products(g, P_.middleCols(6 * filled_, 6));
  S_.middleCols(6 * filled_, 6) = s.transpose();
  if (++filled_ == batch) flush();
}

void PairProducts::flush() {
  K_.noalias() += P_.leftCols(6 * filled_) * S_.leftCols(6 * filled_).transpose();
  filled_ = 0;
}

MatX PairProducts::take() {
  if (filled_ > 0) flush();
  return std::move(K_);
}

MatX symmetric_of(const Eigen::Ref<const VecX>& packed) {
  Eigen::Index n = 0;
  while (n * (n + 1) / 2 < packed.size()) ++n;
  MatX out(n, n);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) out(i, j) = out(j, i) = packed(k++);
  return out;
}

}  // namespace floatframe
