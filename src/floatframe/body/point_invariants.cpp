// The inertia integrals of points with a scalar mass matrix, and of combinations of modes.
#include "floatframe/body/fe_invariants.hpp"

namespace floatframe {

InertiaInvariants invariants_points(const Mat3X& p,
                                    const Eigen::SparseMatrix<double, Eigen::RowMajor>& M_s,
                                    const MatX& X) {
  const Eigen::Index N = p.cols(), nm = X.cols();
  MatX Z(N, 3 * nm + 4);  // (66)
  for (Eigen::Index a = 0; a < nm; ++a)
    for (Eigen::Index k = 0; k < N; ++k)
      for (Eigen::Index i = 0; i < 3; ++i) Z(k, i * nm + a) = X(3 * k + i, a);
  Z.middleCols(3 * nm, 3) = p.transpose();
  Z.col(3 * nm + 3).setOnes();
  MatX G = MatX::Zero(Z.cols(), Z.cols());  // (67)
  // A block of points at a time: the product with M_s stays small.
  constexpr Eigen::Index block = 4096;
  for (Eigen::Index first = 0; first < N; first += block) {
    const Eigen::Index count = std::min(block, N - first);
    const MatX MZ = M_s.middleRows(first, count) * Z;
    G.noalias() += Z.middleRows(first, count).transpose() * MZ;
  }
  G = (0.5 * (G + G.transpose())).eval();
  InertiaInvariants v = InertiaInvariants::zero(static_cast<int>(nm));
  const Eigen::Index one = 3 * nm + 3;
  v.m = G(one, one);
  v.m_u = G.block(3 * nm, one, 3, 1);
  v.P_u = G.block(3 * nm, 3 * nm, 3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    v.S.row(row) = G.block(one, row * nm, 1, nm);
    for (Eigen::Index k = 0; k < 3; ++k) {
      v.Si[i].row(k) = G.block(3 * nm + row, k * nm, 1, nm);
      v.Sij[i][k] = G.block(row * nm, k * nm, nm, nm);
    }
  }
  return v;
}

InertiaInvariants combined(const InertiaInvariants& invariants, const MatX& C) {
  InertiaInvariants v = InertiaInvariants::zero(static_cast<int>(C.cols()));
  v.m = invariants.m;
  v.m_u = invariants.m_u;
  v.P_u = invariants.P_u;
  v.S = invariants.S * C;
  for (std::size_t i = 0; i < 3; ++i) {
    v.Si[i] = invariants.Si[i] * C;
    for (std::size_t j = 0; j < 3; ++j) {
      const MatX right = invariants.Sij[i][j] * C;
      v.Sij[i][j] = C.transpose() * right;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    v.Sij[i][i] = (0.5 * (v.Sij[i][i] + v.Sij[i][i].transpose())).eval();
    for (std::size_t j = 0; j < i; ++j) v.Sij[i][j] = v.Sij[j][i].transpose();
  }
  return v;
}

}  // namespace floatframe
