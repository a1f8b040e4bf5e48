// Prescribed angle of a joint with two axes, e = R_a e_a and n = R_b n_b, of which neither is
// common to both markers (universal): about p, the other axis r turns by the angle. p = e, r = n
// with c >= 0; p = n, r = e with c < 0, against the sense of r. With k = p.r and a body length l:
//   phi        l (alpha - f(t)), within half a turn                          1 row
//              alpha = +-atan2(r.(p x r0), r.(r0 - k p)), r0: r as drawn, fixed in the marker of p
//   gradient   -l g on pi_a, l g on pi_b, g = (p - k r) / (1 - k^2)
//   quad       l gdot.(w_b - w_a)
//   curvature  dg = (dp - dk r - k dr + 2 k dk g) / (1 - k^2), dk = (dpi_p - dpi_r).(p x r)
//   in time    phi_t = -l fdot, phi_tt = -l fddot
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

namespace {

struct DriveAxisAngle {
  bool swapped;  ///< p is fixed in b
  Vec3 p, r, g;
  double k;
  DriveAxisAngle(const ConstraintPart& part, const MarkerState& a, const MarkerState& b) noexcept
      : swapped(part.c < 0.0), p(a.R * part.e_a), r(b.R * part.n_b) {
    if (swapped) p.swap(r);
    k = p.dot(r);
    g = (p - k * r) / (1.0 - k * k);
  }
  /// The changes of g with rotations of the markers of p and of r.
  void changes(Mat3& by_p, Mat3& by_r) const noexcept {
    const Vec3 of_k = p.cross(r), along = 2.0 * k * g - r;
    by_p = (along * of_k.transpose() - skew(p)) / (1.0 - k * k);
    by_r = (k * skew(r) - along * of_k.transpose()) / (1.0 - k * k);
  }
};

}  // namespace

template <>
void constraint_rows_of<ConstraintType::drive_axis_angle>(const ConstraintPart& part,
                                                          const MarkerState& a,
                                                          const MarkerState& b, double t,
                                                          ConstraintRow* rows) noexcept {
  assert(part.motion && is_unit(part.e_a) && is_unit(part.n_b));
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  const DriveAxisAngle x(part, a, b);
  const Vec3 r0 = x.swapped ? Vec3(b.R * part.e_a) : Vec3(a.R * part.n_b);
  const double angle = std::atan2(x.r.dot(x.p.cross(r0)), x.r.dot(r0 - x.p.dot(r0) * x.p));
  rows->phi =
      part.scale * std::remainder((x.swapped ? -angle : angle) - f.f, 2.0 * std::numbers::pi);
  rows->gradient = {Vec3::Zero(), -part.scale * x.g, Vec3::Zero(), part.scale * x.g};
  Mat3 by_p, by_r;
  x.changes(by_p, by_r);
  const Vec3 &w_p = x.swapped ? b.w : a.w, &w_r = x.swapped ? a.w : b.w;
  const Vec3 g_dot = by_p * w_p + by_r * w_r;
  rows->quad = part.scale * g_dot.dot(b.w - a.w);
  rows->phi_t = -part.scale * f.df;
  rows->phi_tt = -part.scale * f.ddf;
}

template <>
void constraint_curvature_of<ConstraintType::drive_axis_angle>(const ConstraintPart& part,
                                                               const MarkerState& a,
                                                               const MarkerState& b,
                                                               const double* lambda,
                                                               Mat12& K) noexcept {
  using namespace part_of;
  const DriveAxisAngle x(part, a, b);
  Mat3 by_a, by_b;
  x.swapped ? x.changes(by_b, by_a) : x.changes(by_a, by_b);
  const double weight = lambda[0] * part.scale;
  K.block<3, 3>(pi_a, pi_a) -= weight * by_a;
  K.block<3, 3>(pi_a, pi_b) -= weight * by_b;
  K.block<3, 3>(pi_b, pi_a) += weight * by_a;
  K.block<3, 3>(pi_b, pi_b) += weight * by_b;
}

constinit const ConstraintKind drive_axis_angle_constraint = {
    .points = false, .angle = true, .holds = "prescribed motion"};

}  // namespace floatframe
