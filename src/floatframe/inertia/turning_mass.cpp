#include "floatframe/inertia/turning_mass.hpp"

#include <cmath>

#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/lanes.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// M_rr^-1, without directions that have no inertia.
Mat6 inverse_of_rigid_mass(const PreprocessingData& data) {
  Mat6 M = Mat6::Zero();
  M.topLeftCorner<3, 3>() = data.m * Mat3::Identity();  // (47)
  M.bottomLeftCorner<3, 3>() = skew(data.m_u);          // (48)
  M.topRightCorner<3, 3>() = -skew(data.m_u);
  M.bottomRightCorner<3, 3>() = data.P_u.trace() * Mat3::Identity() - data.P_u;  // (21)
  const Vec6 s =
      M.diagonal().unaryExpr([](double x) { return x > 0.0 ? 1.0 / std::sqrt(x) : 0.0; });
  const SymmetricEigen eigen = symmetric_eigen(s.asDiagonal() * M * s.asDiagonal());
  Mat6 inverse = Mat6::Zero();
  for (Eigen::Index k = 0; k < 6; ++k)
    if (eigen.values[k] > 1e-10)
      inverse += eigen.vectors.col(k) * eigen.vectors.col(k).transpose() / eigen.values[k];
  return s.asDiagonal() * inverse * s.asDiagonal();
}

}  // namespace

TurningMass::TurningMass(const PreprocessingData& data, const SecondOrder& turning)
    : W_(inverse_of_rigid_mass(data)) {
  const int nm = data.modes();
  H_ = MatX::Zero((6 * nm + 3) & ~3, nm);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const MatX moment = turning.S2i[i][j] - turning.S2i[j][i];
    for (int a = 0; a < nm; ++a) {
      H_.row(6 * a + k) = turning.S2[k].row(a);
      H_.row(6 * a + 3 + k) = moment.row(a);
    }
  }
  C_ = rate_ = VecX::Zero(H_.rows());
  C_rows_ = D_rows_ = MatX::Zero((nm + 3) & ~3, 6);
}

void TurningMass::add(const double* y, const double* ydot, int first, MatX& M, VecX& Qv) noexcept {
  const int nm = static_cast<int>(H_.cols()), rows = static_cast<int>(C_.size());
  // C by modes and its rate, four numbers at a time; rows are filled up to whole lanes.
  double *c = C_.data(), *rate = rate_.data();
  for (int r = 0; r < rows; r += 4) lanes(c + r) = lanes(rate + r) = Lanes{};
  for (int b = 0; b < nm; ++b) {
    const double* column = H_.data() + static_cast<std::ptrdiff_t>(b) * rows;
    for (int r = 0; r < rows; r += 4) {
      lanes(c + r) += y[b] * lanes(column + r);
      lanes(rate + r) += ydot[b] * lanes(column + r);
    }
  }
  Vec6 h = Vec6::Zero();
  for (int a = 0; a < nm; ++a) h += ydot[a] * rate_.segment<6>(6 * a);
  for (int a = 0; a < nm; ++a) {
    const Vec6 C = C_.segment<6>(6 * a), D = W_ * C;
    Qv[first + a] -= D.dot(h);
    for (int k = 0; k < 6; ++k) {
      C_rows_(a, k) = C[k];
      D_rows_(a, k) = D[k];
    }
  }
  const int n = static_cast<int>(C_rows_.rows());
  for (int b = 0; b < nm; ++b) {
    double c_b[6];
    for (int k = 0; k < 6; ++k) c_b[k] = C_rows_(b, k);
    double* column = M.data() + static_cast<std::ptrdiff_t>(first + b) * M.rows() + first;
    for (int r = 0; r < nm; r += 4) {
      Lanes more = {};
      for (int k = 0; k < 6; ++k) more += c_b[k] * lanes(D_rows_.data() + k * n + r);
      const int count = nm - r < 4 ? nm - r : 4;
      if (count == 4)
        lanes(column + r) += more;
      else
        for (int l = 0; l < count; ++l) column[r + l] += more[l];
    }
  }
}

double TurningMass::energy(const double* y, const double* ydot) const noexcept {
  const int nm = static_cast<int>(H_.cols());
  Vec6 moved = Vec6::Zero();  // C ydot
  for (int b = 0; b < nm; ++b)
    for (int a = 0; a < nm; ++a) moved += (ydot[a] * y[b]) * H_.col(b).segment<6>(6 * a);
  return 0.5 * moved.dot(W_ * moved);
}

}  // namespace floatframe
