// Linear systems of the absolute formulation, reduced to the motions that satisfy the internal
// constraints (1), (2) of the bodies: (5), (6) of absolute.hpp.
//
// With A orthonormal, (1) depends on the stretch part A E of delta A, E symmetric, and not on A x
// skew. So the rows (1) with values phi are satisfied by delta A = -1/2 A E with
//   E_kk = 2 phi_kk / l,  E_ab = phi_ab / l,                                              (7)
// and multipliers of (1) balance the stretch of a residual R_A = [R_u R_v R_w]:
//   R_A + l A W,  W = -sym(A^T R_A) / l, has none.                                        (8)
#include <cassert>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {

namespace {

/// The rotation nearest to A (Newton-Schulz), or `otherwise` if there is none.
Mat3 orthonormal(Mat3 A, const Mat3& otherwise) noexcept {
  // Singular values below sqrt(3) converge; none exceeds sqrt(3) times their quadratic mean.
  const double mean = A.norm() / std::sqrt(3.0);
  if (std::abs(mean - 1.0) > 0.1) A /= 1.001 * mean;
  constexpr int most = 30;
  for (int pass = 0; pass < most; ++pass) {
    const Mat3 error = A.transpose() * A - Mat3::Identity();
    A -= (0.5 * A * error).eval();
    if (error.cwiseAbs().maxCoeff() < 1e-8)  // squared by this pass
      return A.determinant() > 0.0 ? A : otherwise;
  }
  return otherwise;
}

}  // namespace

/// B^T x
void AbsoluteFormulation::gather(const BodyData& b, const VecX& x, double* z) const noexcept {
  Vec3 force = x.segment<3>(b.offset), torque = Vec3::Zero();
  for (int c = 0; c < 3; ++c) torque += b.A.col(c).cross(x.segment<3>(b.offset + 3 + 3 * c));
  for (int k = 0; k < b.nm; ++k) z[6 + k] = x[b.offset + 12 + k];
  for (int p = 0; p < b.points; ++p) {
    const MarkerData& m = point(b, p);
    const Vec3 f = x.segment<3>(b.offset + 12 + b.nm + 3 * p);
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
void AbsoluteFormulation::spread(const BodyData& b, const double* z, VecX& x) const noexcept {
  const Vec3 shift(z[0], z[1], z[2]), theta(z[3], z[4], z[5]);
  x.segment<3>(b.offset) = shift;
  for (int c = 0; c < 3; ++c) x.segment<3>(b.offset + 3 + 3 * c) = theta.cross(b.A.col(c));
  for (int k = 0; k < b.nm; ++k) x[b.offset + 12 + k] = z[6 + k];
  for (int p = 0; p < b.points; ++p) {
    const MarkerData& m = point(b, p);
    Vec3 moved = shift + theta.cross(m.s.r - b.p_WB);
    if (m.local)
      for (int k = 0; k < b.nm; ++k) moved += z[6 + k] * m.Jr.col(k);
    x.segment<3>(b.offset + 12 + b.nm + 3 * p) = moved;
  }
}

bool AbsoluteFormulation::own_constraints_hold(const VecX& phi) const noexcept {
  constexpr double round_off = 1e-14;
  for (const BodyData& b : bodies_)
    for (int r = 0; r < b.rows(); ++r)
      if (!(std::abs(phi[b.row + r]) <= round_off * b.length)) return false;
  return true;
}

/// p such that (1) and (2) have the increments -phi, by stretching the axes and moving the points.
void AbsoluteFormulation::own_correction(const VecX& phi, VecX& p) const noexcept {
  p.setZero();
  for (const BodyData& b : bodies_) {
    Mat3 E;  // (7)
    for (int k = 0; k < 6; ++k)
      E(pair_a[k], pair_b[k]) = E(pair_b[k], pair_a[k]) =
          (k < 3 ? 2.0 : 1.0) * phi[b.row + k] / b.length;
    const Mat3 stretch = -0.5 * b.A * E;
    for (int c = 0; c < 3; ++c) p.segment<3>(b.offset + 3 + 3 * c) = stretch.col(c);
    for (int k = 0; k < b.points; ++k)
      p.segment<3>(b.offset + 12 + b.nm + 3 * k) =
          stretch * point(b, k).p_B - phi.segment<3>(b.row + 6 + 3 * k);
  }
}

void AbsoluteFormulation::solve(VecX& b, int slot) noexcept {
  assert(calls_.has_factors(slot) && b.size() == nq_);
  BlockLdlt& matrix = factors_[slot].matrix;
  unknowns_.setZero();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    gather(bodies_[i], b, unknowns_.data() + matrix.offset(static_cast<int>(i)));
  matrix.solve(unknowns_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    spread(bodies_[i], unknowns_.data() + matrix.offset(static_cast<int>(i)), b);
}

void AbsoluteFormulation::solve(VecX& b, const VecX& phi, double penalty, VecX& mu,
                                int slot) noexcept {
  assert(calls_.has_factors(slot) && b.size() == nq_);
  assert(phi.size() == constraints() && mu.size() == constraints() && penalty > 0.0);
  assert(std::abs(penalty - factors_[slot].penalty) <= 1e-9 * penalty);
  BlockLdlt& matrix = factors_[slot].matrix;
  unknowns_.setZero();
  const bool corrects = !own_constraints_hold(phi);
  if (corrects) {
    // x = p + B z: contributions of p to the mass terms and to (3).
    own_correction(phi, correction_);
    for (const BodyData& body : bodies_) {
      const int n = 12 + body.nm;
      b.segment(body.offset, n).noalias() -= body.M * correction_.segment(body.offset, n);
    }
    constraint_set_.increments([&](int marker) { return increment_of(marker, correction_); },
                               across_);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    gather(bodies_[i], b, unknowns_.data() + matrix.offset(static_cast<int>(i)));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const PartPlace& place = places_[k];
    if (place.home < 0) continue;
    double* rows = unknowns_.data() + matrix.offset(place.home) + place.at;
    const int first = constraint_set_.offset(k), count = constraint_set_.parts()[k].rows();
    for (int r = 0; r < count; ++r)
      rows[r] = -phi[first + r] - (corrects ? across_[first + r] : 0.0);
  }
  matrix.solve(unknowns_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    spread(bodies_[i], unknowns_.data() + matrix.offset(static_cast<int>(i)), b);
  if (corrects) b += correction_;
  mu.setZero();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const PartPlace& place = places_[k];
    if (place.home < 0) continue;
    const double* rows = unknowns_.data() + matrix.offset(place.home) + place.at;
    const int first = constraint_set_.offset(k), count = constraint_set_.parts()[k].rows();
    for (int r = 0; r < count; ++r) mu[first + r] = rows[r] / penalty;
  }
}

/// First the forces on outer points are transferred to their bodies, (2), then (8) is applied.
void AbsoluteFormulation::balance(VecX& lambda, VecX& r) noexcept {
  assert(calls_.has(CallOrder::residual));
  assert(lambda.size() == constraints() && r.size() == nq_);
  for (const BodyData& b : bodies_) {
    for (int p = 0; p < b.points; ++p) {
      const int at = b.offset + 12 + b.nm + 3 * p;
      const Vec3 force = r.segment<3>(at);
      lambda.segment<3>(b.row + 6 + 3 * p) -= force;
      add_wrench(b.point_marker[p], false, force, Vec3::Zero(), r);
      r.segment<3>(at).setZero();
    }
    Mat3 R;
    for (int c = 0; c < 3; ++c) R.col(c) = r.segment<3>(b.offset + 3 + 3 * c);
    const Mat3 product = b.A.transpose() * R;
    const Mat3 W = -0.5 * (product + product.transpose());
    R += b.A * W;
    for (int c = 0; c < 3; ++c) r.segment<3>(b.offset + 3 + 3 * c) = R.col(c);
    for (int k = 0; k < 6; ++k) lambda[b.row + k] += W(pair_a[k], pair_b[k]) / b.length;
  }
  constraint_set_.set_multipliers(lambda, 0.0);
}

/// Makes the axes orthonormal and moves the outer points to their bodies.
void AbsoluteFormulation::settle(const VecX& q0, VecX& x) const noexcept {
  assert(q0.size() == nq_ && x.size() == nq_);
  stiffens_ ? settle_of<true>(q0, x) : settle_of<false>(q0, x);
}

template <bool stiffens>
void AbsoluteFormulation::settle_of(const VecX& q0, VecX& x) const noexcept {
  for (const BodyData& b : bodies_) {
    Mat3 A, A0;
    for (int c = 0; c < 3; ++c) {
      A0.col(c) = q0.segment<3>(b.offset + 3 + 3 * c);
      A.col(c) = A0.col(c) + x.segment<3>(b.offset + 3 + 3 * c);
    }
    A = orthonormal(A, A0);
    assert(is_rotation(A));  // of a state: A0 is one
    for (int c = 0; c < 3; ++c)
      x.segment<3>(b.offset + 3 + 3 * c) = A.col(c) - q0.segment<3>(b.offset + 3 + 3 * c);
    const Vec3 origin = q0.segment<3>(b.offset) + x.segment<3>(b.offset);
    const double *y = q0.data() + b.offset + 12, *dy = x.data() + b.offset + 12;
    for (int p = 0; p < b.points; ++p) {
      const int at = b.offset + 12 + b.nm + 3 * p;
      x.segment<3>(at) = origin + A * point(b, p).position<stiffens>(y, dy) - q0.segment<3>(at);
    }
  }
}

void AbsoluteFormulation::advance(VecX& x, const VecX& delta) const noexcept {
  assert(calls_.has(CallOrder::positions));
  assert(x.size() == nq_ && delta.size() == nq_);
  stiffens_ ? advance_of<true>(x, delta) : advance_of<false>(x, delta);
}

template <bool stiffens>
void AbsoluteFormulation::advance_of(VecX& x, const VecX& delta) const noexcept {
  for (const BodyData& b : bodies_) {
    Vec3 theta = Vec3::Zero();  // of (5): the stretch has none
    for (int c = 0; c < 3; ++c)
      theta += 0.5 * b.A.col(c).cross(delta.segment<3>(b.offset + 3 + 3 * c));
    const Mat3 turned = rotation_exp(theta) * b.A;
    const Mat3 A = orthonormal(turned, turned);
    x.segment<3>(b.offset) += delta.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) x.segment<3>(b.offset + 3 + 3 * c) += A.col(c) - b.A.col(c);
    x.segment(b.offset + 12, b.nm) += delta.segment(b.offset + 12, b.nm);
    const Vec3 origin = b.p_WB + delta.segment<3>(b.offset);
    const double* dy = delta.data() + b.offset + 12;
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = point(b, p);
      x.segment<3>(b.offset + 12 + b.nm + 3 * p) +=
          origin + A * m.position<stiffens>(b.y.data(), dy) - m.r_P;
    }
  }
}

}  // namespace floatframe
