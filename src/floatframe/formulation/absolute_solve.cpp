// Solutions of (6) of absolute_tangent.hpp, and what balances the rows of the bodies.
#include <cassert>

#include "floatframe/formulation/absolute_tangent.hpp"

namespace floatframe {

/// B^T x
void AbsoluteTangent::gather(const AbsoluteBody& b, const VecX& x, double* z) const noexcept {
  Vec3 force = x.segment<3>(b.offset), torque = Vec3::Zero();
  for (int c = 0; c < 3; ++c) torque += b.A.col(c).cross(x.segment<3>(b.axis(c)));
  for (int k = 0; k < b.nm; ++k) z[6 + k] = x[b.offset + 12 + k];
  for (int p = 0; p < b.points; ++p) {
    const AbsoluteMarker& m = kinematics_.point(b, p);
    const Vec3 f = x.segment<3>(b.point(p));
    force += f;
    torque += (m.s.r - b.p_WB).cross(f);
    if (m.local)
      for (int k = 0; k < b.nm; ++k) z[6 + k] += m.Jr.col(k).dot(f);
  }
  for (int c = 0; c < 3; ++c) {
    z[c] = force[c];
    z[3 + c] = torque[c];
  }
}

/// x = B z
void AbsoluteTangent::spread(const AbsoluteBody& b, const double* z, VecX& x) const noexcept {
  const Vec3 shift(z[0], z[1], z[2]), theta(z[3], z[4], z[5]);
  x.segment<3>(b.offset) = shift;
  for (int c = 0; c < 3; ++c) x.segment<3>(b.axis(c)) = theta.cross(b.A.col(c));
  for (int k = 0; k < b.nm; ++k) x[b.offset + 12 + k] = z[6 + k];
  for (int p = 0; p < b.points; ++p) {
    const AbsoluteMarker& m = kinematics_.point(b, p);
    Vec3 moved = shift + theta.cross(m.s.r - b.p_WB);
    if (m.local)
      for (int k = 0; k < b.nm; ++k) moved += z[6 + k] * m.Jr.col(k);
    x.segment<3>(b.point(p)) = moved;
  }
}

bool AbsoluteTangent::own_constraints_hold(const VecX& phi) const noexcept {
  constexpr double round_off = 1e-14;
  for (const AbsoluteBody& b : bodies_)
    for (int r = 0; r < b.rows(); ++r)
      if (!(std::abs(phi[b.row + r]) <= round_off * b.length)) return false;
  return true;
}

/// p such that (1) and (2) have the increments -phi, by stretching the axes and moving the points.
void AbsoluteTangent::own_correction(const VecX& phi, VecX& p) const noexcept {
  p.setZero();
  for (const AbsoluteBody& b : bodies_) {
    Mat3 E;  // (7)
    for (int k = 0; k < 6; ++k)
      E(b.pair_a[k], b.pair_b[k]) = E(b.pair_b[k], b.pair_a[k]) =
          (k < 3 ? 2.0 : 1.0) * phi[b.row + k] / b.length;
    const Mat3 stretch = -0.5 * b.A * E;
    for (int c = 0; c < 3; ++c) p.segment<3>(b.axis(c)) = stretch.col(c);
    for (int k = 0; k < b.points; ++k)
      p.segment<3>(b.point(k)) =
          stretch * kinematics_.point(b, k).p_B - phi.segment<3>(b.point_row(k));
  }
}

void AbsoluteTangent::solve(VecX& b, int slot) noexcept {
  assert(b.size() == kinematics_.size());
  BlockLdlt& matrix = factors_[slot];
  unknowns_.setZero();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    gather(bodies_[i], b, unknowns_.data() + matrix.offset(static_cast<int>(i)));
  matrix.solve(unknowns_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    spread(bodies_[i], unknowns_.data() + matrix.offset(static_cast<int>(i)), b);
}

void AbsoluteTangent::solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept {
  assert(b.size() == kinematics_.size() && phi.size() == mu.size() && penalty > 0.0);
  BlockLdlt& matrix = factors_[slot];
  const bool corrects = !own_constraints_hold(phi);
  if (corrects) {
    // x = p + B z: contributions of p to the mass terms and to (3).
    own_correction(phi, correction_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const int at = bodies_[i].offset, n = 12 + bodies_[i].nm;
      b.segment(at, n).noalias() -= terms_[i].M * correction_.segment(at, n);
    }
    constraints_.increments(
        [&](int marker) { return kinematics_.increment_of(marker, correction_); }, across_);
  }
  unknowns_.setZero();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    gather(bodies_[i], b, unknowns_.data() + matrix.offset(static_cast<int>(i)));
  const auto each_row = [&](const auto& use) {  // the row of a part, its unknown
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const PartPlace& place = places_[k];
      if (place.home < 0) continue;
      double* rows = unknowns_.data() + matrix.offset(place.home) + place.at;
      const int first = constraints_.offset(k), count = constraints_.parts()[k].rows();
      for (int r = 0; r < count; ++r) use(first + r, rows[r]);
    }
  };
  each_row([&](int row, double& x) { x = -phi[row] - (corrects ? across_[row] : 0.0); });
  matrix.solve(unknowns_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    spread(bodies_[i], unknowns_.data() + matrix.offset(static_cast<int>(i)), b);
  if (corrects) b += correction_;
  mu.setZero();
  each_row([&](int row, double x) { mu[row] = x / penalty; });
}

/// First the forces on outer points are transferred to their bodies, (2), then (8) is applied.
void AbsoluteTangent::balance(VecX& lambda, VecX& r) const noexcept {
  assert(r.size() == kinematics_.size());
  for (const AbsoluteBody& b : bodies_) {
    for (int p = 0; p < b.points; ++p) {
      const Vec3 force = r.segment<3>(b.point(p));
      lambda.segment<3>(b.point_row(p)) -= force;
      kinematics_.add_wrench(b.point_marker[p], false, force, Vec3::Zero(), r);
      r.segment<3>(b.point(p)).setZero();
    }
    Mat3 R;
    for (int c = 0; c < 3; ++c) R.col(c) = r.segment<3>(b.axis(c));
    const Mat3 product = b.A.transpose() * R;
    const Mat3 W = -0.5 * (product + product.transpose());
    R += b.A * W;
    for (int c = 0; c < 3; ++c) r.segment<3>(b.axis(c)) = R.col(c);
    for (int k = 0; k < 6; ++k) lambda[b.row + k] += W(b.pair_a[k], b.pair_b[k]) / b.length;
  }
}

}  // namespace floatframe
