// Prescribed distance of the points of a and b. With d = r_b - r_a, s = |d|, n = d / s:
//   phi        s - f(t) = 0                                   1 row
//   gradient   -n on r_a, n on r_b
//   quad       (ddot.ddot - (n.ddot)^2) / s
//   curvature  dn = (I - n n^T) (dr_b - dr_a) / s
//   in time    phi_t = -fdot, phi_tt = -fddot
// The multiplier is the force between the points [N], tension positive.
#include <cassert>

#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::drive_distance>(const ConstraintPart& part,
                                                        const MarkerState& a, const MarkerState& b,
                                                        double t, ConstraintRow* rows) noexcept {
  assert(part.motion);
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  const Vec3 d = b.r - a.r, d_dot = b.v - a.v;
  const double s = d.norm();
  const Vec3 n = d / s;
  const double rate = n.dot(d_dot);
  rows->phi = s - f.f;
  rows->gradient = {-n, Vec3::Zero(), n, Vec3::Zero()};
  rows->quad = (d_dot.squaredNorm() - rate * rate) / s;
  rows->phi_t = -f.df;
  rows->phi_tt = -f.ddf;
}

template <>
void constraint_curvature_of<ConstraintType::drive_distance>(const ConstraintPart&,
                                                             const MarkerState& a,
                                                             const MarkerState& b,
                                                             const double* lambda,
                                                             Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 d = b.r - a.r;
  const Mat3 P = (lambda[0] / d.norm()) * (Mat3::Identity() - d * d.transpose() / d.squaredNorm());
  K.block<3, 3>(r_a, r_a) += P;
  K.block<3, 3>(r_b, r_b) += P;
  K.block<3, 3>(r_a, r_b) -= P;
  K.block<3, 3>(r_b, r_a) -= P;
}

constinit const ConstraintKind drive_distance_constraint = {.holds = "prescribed length"};

}  // namespace floatframe
