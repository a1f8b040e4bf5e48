#include "floatframe/inertia/turning_mass.hpp"

#include <cmath>

#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/math/dense.hpp"
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
    : inverse_(inverse_of_rigid_mass(data)) {
  const int nm = data.modes();
  Mat6X M_rf(6, nm);
  H_ = MatX::Zero(6 * nm, nm);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    M_rf.row(k) = data.S.row(k);
    M_rf.row(3 + k) = data.Si.row(3 * i + j) - data.Si.row(3 * j + i);  // F_bar
    const MatX moment = turning.S2i[i][j] - turning.S2i[j][i];
    for (int a = 0; a < nm; ++a) {
      H_.row(6 * a + k) = turning.S2[k].row(a);
      H_.row(6 * a + 3 + k) = moment.row(a);
    }
  }
  B_ = inverse_ * M_rf;
  C_ = E_ = Mat6X::Zero(6, nm);
}

void TurningMass::add(const double* y, const double* ydot, int first, MatX& M, VecX& Qv) noexcept {
  const int nm = static_cast<int>(B_.cols());
  C_.setZero();
  Vec6 h = Vec6::Zero();
  for (int b = 0; b < nm; ++b)
    for (int a = 0; a < nm; ++a) {
      const auto column = H_.col(b).segment<6>(6 * a);
      C_.col(a) += y[b] * column;
      h += (ydot[a] * ydot[b]) * column;
    }
  for (int a = 0; a < nm; ++a) {
    const Vec6 D = inverse_ * C_.col(a);
    E_.col(a) = B_.col(a) + 0.5 * D;
    Qv[first + a] -= (B_.col(a) + D).dot(h);
  }
  for (int a = 0; a < nm; ++a)
    for (int b = 0; b <= a; ++b) {
      const double more = E_.col(a).dot(C_.col(b)) + C_.col(a).dot(E_.col(b));
      M(first + a, first + b) += more;
      if (a != b) M(first + b, first + a) += more;
    }
}

double TurningMass::energy(const double* y, const double* ydot) const noexcept {
  const int nm = static_cast<int>(B_.cols());
  Vec6 moved = Vec6::Zero(), frame = Vec6::Zero();  // C ydot, B ydot
  for (int b = 0; b < nm; ++b) {
    frame += ydot[b] * B_.col(b);
    for (int a = 0; a < nm; ++a) moved += (ydot[a] * y[b]) * H_.col(b).segment<6>(6 * a);
  }
  return moved.dot(frame + 0.5 * (inverse_ * moved));
}

}  // namespace floatframe
