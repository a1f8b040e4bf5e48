#include "floatframe/model/slide_path.hpp"

#include <cassert>

#include "floatframe/math/cubic_spline.hpp"

namespace floatframe {

namespace {

PointOnCurve drawn_path(const Mat3X& p) {
  PointOnCurve keys;
  keys.points = (p.colwise() - p.col(0)).transpose();
  return keys;
}

}  // namespace

SlidePath::SlidePath(std::vector<int> nodes, const Mat3X& p)
    : nodes_(std::move(nodes)), p_(p), drawn_(drawn_path(p)) {
  const Eigen::Index n = p.cols();
  assert(n >= 2 && std::ssize(nodes_) == n);
  u_.push_back(0.0);
  for (Eigen::Index k = 1; k < n; ++k) u_.push_back(u_.back() + (p.col(k) - p.col(k - 1)).norm());
  curvatures_ = MatX::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    std::vector<TablePoint> unit;
    for (Eigen::Index j = 0; j < n; ++j) unit.push_back({u_[j], j == k ? 1.0 : 0.0});
    const PiecewisePolynomial spline = cubic_spline(unit, SplineEnds::open);
    // Of the pieces between the knots: beyond the ends there is no curvature.
    for (Eigen::Index j = 0; j < n; ++j)
      curvatures_(k, j) = spline.piece_value(std::max<Eigen::Index>(j, 1), u_[j]).ddf;
  }
}

void SlidePath::weights(double u, VecX& N, VecX& dN, VecX& ddN) const noexcept {
  assert(N.size() == size() && dN.size() == size() && ddN.size() == size());
  const double at = std::clamp(u, u_.front(), u_.back());
  const auto above = std::upper_bound(u_.begin() + 1, u_.end() - 1, at);
  const Eigen::Index j = above - u_.begin() - 1;
  const double h = u_[j + 1] - u_[j], b = (at - u_[j]) / h, a = 1.0 - b;
  const double ca = (a * a * a - a) * h * h / 6.0, cb = (b * b * b - b) * h * h / 6.0;
  const double da = -(3.0 * a * a - 1.0) * h / 6.0, db = (3.0 * b * b - 1.0) * h / 6.0;
  N.noalias() = ca * curvatures_.col(j) + cb * curvatures_.col(j + 1);
  dN.noalias() = da * curvatures_.col(j) + db * curvatures_.col(j + 1);
  ddN.noalias() = a * curvatures_.col(j) + b * curvatures_.col(j + 1);
  N[j] += a;
  N[j + 1] += b;
  dN[j] -= 1.0 / h;
  dN[j + 1] += 1.0 / h;
  if (u == at) return;
  N += (u - at) * dN;
  ddN.setZero();
}

}  // namespace floatframe
