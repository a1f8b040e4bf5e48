#include "floatframe/body/modal_mass.hpp"

#include <cmath>
#include <vector>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// A mode is taken as massless below this part of the largest modal mass, unless its frequency is
/// of a magnitude with that of the others: rounding, squared.
constexpr double no_mass = 1e-14;

}  // namespace

MatX momentum_of_modes(const InertiaInvariants& v) {
  MatX B(6, v.modes());
  B.topRows(3) = v.S;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    B.row(3 + static_cast<Eigen::Index>(i)) =
        v.Si[j].row(static_cast<Eigen::Index>(k)) - v.Si[k].row(static_cast<Eigen::Index>(j));
  }
  return B;
}

MatX modal_mass(const InertiaInvariants& v) { return v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2]; }

MatX mass_matrix_at_rest(const InertiaInvariants& v) {
  const Eigen::Index nm = v.modes();
  MatX M = MatX::Zero(6 + nm, 6 + nm);
  M.topLeftCorner<3, 3>() = v.m * Mat3::Identity();
  M.block<3, 3>(0, 3) = -skew(v.m_u);
  M.block<3, 3>(3, 0) = skew(v.m_u);
  M.block<3, 3>(3, 3) = v.inertia_about_origin();
  M.topRightCorner(6, nm) = momentum_of_modes(v);
  M.bottomLeftCorner(nm, 6) = M.topRightCorner(6, nm).transpose();
  M.bottomRightCorner(nm, nm) = modal_mass(v);
  return M;
}

double relative_modal_mass(const InertiaInvariants& v, const Mat6X& free, const MatX& K) {
  const Eigen::Index nm = v.modes();
  const MatX M_ff = modal_mass(v);
  const double top = nm > 0 ? M_ff.diagonal().maxCoeff() : 0.0;
  std::vector<Eigen::Index> massive;
  // A massless mode has a separate frequency beyond all others.
  double lowest = 0.0;
  if (K.rows() == nm)
    for (Eigen::Index k = 0; k < nm; ++k)
      if (K(k, k) > 0.0 && M_ff(k, k) > 0.0 && !(K(k, k) > lowest * M_ff(k, k) && lowest > 0.0))
        lowest = K(k, k) / M_ff(k, k);
  for (Eigen::Index k = 0; k < nm; ++k)
    if (M_ff(k, k) > no_mass * top ||
        (lowest > 0.0 && M_ff(k, k) > 0.0 && no_mass * K(k, k) < lowest * M_ff(k, k)))
      massive.push_back(k);
  if (massive.empty() || !(v.m > 0.0)) return 1.0;

  // Lengths in units of the radius of gyration, so that translations and rotations are comparable.
  const double l = std::sqrt(std::max(v.inertia_about_origin().trace() / v.m, 1e-300));
  MatX M = mass_matrix_at_rest(v);
  M.middleRows<3>(3) /= l;
  M.middleCols<3>(3) /= l;
  MatX own = M_ff;
  if (free.cols() > 0) {
    Mat6X Z = free;
    Z.bottomRows<3>() *= l;
    for (Eigen::Index k = 0; k < Z.cols(); ++k) Z.col(k).normalize();
    const MatX M_rr = Z.transpose() * M.topLeftCorner<6, 6>() * Z;
    const MatX M_rf = Z.transpose() * M.topRightCorner(6, nm);
    const SymmetricEigen rigid = symmetric_eigen(M_rr);
    for (Eigen::Index k = 0; k < M_rr.rows(); ++k) {
      const double mass = rigid.values[k];
      if (!(mass > 1e-10 * v.m)) continue;
      const VecX g = M_rf.transpose() * rigid.vectors.col(k);
      own -= g * g.transpose() / mass;
    }
  }
  const auto n = static_cast<Eigen::Index>(massive.size());
  MatX scaled(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index a = massive[i];
      const Eigen::Index b = massive[j];
      scaled(i, j) = own(a, b) / std::sqrt(M_ff(a, a) * M_ff(b, b));
    }
  return symmetric_eigenvalues(scaled)[0];
}

}  // namespace floatframe
