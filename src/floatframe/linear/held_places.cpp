#include "floatframe/linear/held_places.hpp"

#include "floatframe/math/dense.hpp"

namespace floatframe {

namespace {

/// Smaller parts are those of roots that rounding parts, about its root.
constexpr double negligible = 1e-6;
constexpr double rounding = 1e-10;

}  // namespace

HeldPlaces::HeldPlaces(const LinearSystem& system) : system_(system) {
  const Eigen::Index ns = system.elements_of.rows(), nv = system.v_of.rows();
  // The slowest motions alone do not show what a state moves.
  if (ns == 0 || system.fastest > 0.0) return;
  MatX all(2 * nv + ns, system.A.rows());
  all << system.x_of, system.v_of, system.elements_of;
  const MatX back = LeastNorm(all).pseudo_inverse();
  const MatX rates = system.elements_of * system.A, of_states = back.rightCols(ns),
             slopes = rates * of_states;
  MatX follow = rates * back.middleCols(nv, nv) * system.x_of;
  for (Eigen::Index i = 0; i < ns; ++i) {
    const double size = rounding * rates.row(i).norm();
    if (slopes.row(i).norm() > size || !(follow.row(i).norm() > size * system.x_of.norm()))
      follow.row(i).setZero();
  }
  const MatX forces = system.v_of * system.A, P = forces * of_states * follow;  // (1)
  if (P.norm() > rounding * forces.norm() * follow.norm()) P_ = P;
}

bool HeldPlaces::holds(const LinearMode& mode) const {
  if (P_.size() == 0) return false;
  return (P_ * mode.z).norm() > negligible * P_.norm() * (system_.x_of * mode.z).norm();
}

MatX HeldPlaces::free(const MatX& z) const {
  if (P_.size() == 0 || z.cols() == 0) return z;
  MatX unit = z;
  for (Eigen::Index k = 0; k < z.cols(); ++k) unit.col(k) /= (system_.x_of * z.col(k)).norm();
  const MatX held = P_ * unit;
  if (!(held.norm() > negligible * P_.norm())) return z;
  const PivotedQr columns = pivoted_qr(held, negligible);
  const Eigen::Index rank = columns.rank, left = z.cols() - rank;
  MatX those(held.rows(), rank), basis(z.rows(), rank), out(z.rows(), left);
  for (Eigen::Index k = 0; k < rank; ++k) {
    those.col(k) = held.col(columns.pivots[k]);
    basis.col(k) = unit.col(columns.pivots[k]);
  }
  const LeastNorm parts(those);
  for (Eigen::Index k = 0; k < left; ++k) {
    const Eigen::Index other = columns.pivots[rank + k];
    out.col(k) = unit.col(other) - basis * parts.solve(VecX(held.col(other)));
  }
  return out;
}

}  // namespace floatframe
