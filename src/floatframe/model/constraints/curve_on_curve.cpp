// Curves touch: a curve of a and one of b have a common tangent in their contact
// (curve_contact.hpp). With p and q in world axes, the normal n, t and D = r_b + q - r_a - p there:
//   phi        n.D = 0                                                          1 row
// The derivatives of phi by the parameters u and w vanish in the contact, so with both held:
//   gradient   that along the axis n that rotates with a (axis_row.hpp), of the point r_b + q,
//              and q x n on pi_b
// and with g_1 = t.D, g_2 = n.q' = 0, |p'| = s', kappa s' = c:
//   (du, dw) = -J^-1 (dg_1, dg_2),  J = [c phi - s', t.q'; -c t.q', n.q'']
//   quad       that of the axis, n.(w_b x (w_b x q)), and -c g_1dot udot + g_2dot wdot
//   curvature  that of the axis and of q x n, and -c dg_1 du^T + dg_2 dw^T, symmetric
// a is the marker of the first curve of the contact: b of the part, if the curves are swapped.
#include <cassert>
#include <utility>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/axis_row.hpp"
#include "floatframe/model/curve_contact.hpp"

namespace floatframe {

namespace {

/// The contact in world axes, and b moved to the point of its curve.
struct TouchingCurves {
  CurveContact::Point c;
  MarkerState at;
  double j11, j12, j21, j22, det;

  TouchingCurves(const CurveContact& curves, const MarkerState& a, const MarkerState& b) noexcept
      : c(curves.at(a.R.transpose() * b.R, a.R.transpose() * (b.r - a.r))), at(b) {
    for (Vec3* x : {&c.n, &c.t, &c.q, &c.dq}) *x = a.R * *x;
    at.r += c.q;
    at.v += b.w.cross(c.q);
    j11 = c.turn * c.phi - c.speed;
    j12 = c.along;
    j21 = -c.turn * c.along;
    j22 = c.bend;
    det = j11 * j22 - j12 * j21;
  }
};

void touching_row(const CurveContact& curves, const MarkerState& a, const MarkerState& b,
                  ConstraintRow& row) noexcept {
  const TouchingCurves x(curves, a, b);
  const CurveContact::Point& c = x.c;
  fill_axis_row(c.n, a, x.at, row);
  row.phi = c.phi;
  row.gradient.b.T = c.q.cross(c.n);
  row.quad += c.n.dot(b.w.cross(b.w.cross(c.q)));
  const double g1 = axis_measure(c.t, a, x.at).rate, g2 = (b.w - a.w).dot(c.dq.cross(c.n));
  const double du = -(x.j22 * g1 - x.j12 * g2) / x.det, dw = -(x.j11 * g2 - x.j21 * g1) / x.det;
  row.quad += g2 * dw - c.turn * g1 * du;
}

void add_touching_curvature(const CurveContact& curves, const MarkerState& a, const MarkerState& b,
                            double lambda, Mat12& K) noexcept {
  using namespace part_of;
  const TouchingCurves x(curves, a, b);
  const CurveContact::Point& c = x.c;
  add_axis_curvature(c.n, a, x.at, lambda, K);
  const Mat3 N = lambda * skew(c.n), Q = skew(c.q);
  K.block<3, 3>(pi_a, pi_b) -= N * Q;
  K.block<3, 3>(pi_b, pi_a) -= Q * N;
  Mat3 turn = lambda * c.q * c.n.transpose();
  turn.diagonal().array() -= lambda * c.q.dot(c.n);
  K.block<3, 3>(pi_b, pi_b) += turn;
  WrenchRow along = axis_measure(c.t, a, x.at).g;
  along.b.T = c.q.cross(c.t);
  const Vec3 tilt = c.dq.cross(c.n);
  const Vec12 g1 = stacked(along), g2 = stacked({{Vec3::Zero(), -tilt}, {Vec3::Zero(), tilt}});
  const Vec12 du = -(x.j22 * g1 - x.j12 * g2) / x.det, dw = -(x.j11 * g2 - x.j21 * g1) / x.det;
  K += lambda * (g2 * dw.transpose() - c.turn * g1 * du.transpose());
}

}  // namespace

template <>
void constraint_rows_of<ConstraintType::curve_on_curve>(const ConstraintPart& part,
                                                        const MarkerState& a, const MarkerState& b,
                                                        double, ConstraintRow* rows) noexcept {
  assert(part.curves);
  if (!part.curves->swapped()) return touching_row(*part.curves, a, b, *rows);
  touching_row(*part.curves, b, a, *rows);
  std::swap(rows->gradient.a, rows->gradient.b);
}

template <>
void constraint_curvature_of<ConstraintType::curve_on_curve>(const ConstraintPart& part,
                                                             const MarkerState& a,
                                                             const MarkerState& b,
                                                             const double* lambda,
                                                             Mat12& K) noexcept {
  if (!part.curves->swapped()) return add_touching_curvature(*part.curves, a, b, lambda[0], K);
  Mat12 other = Mat12::Zero();
  add_touching_curvature(*part.curves, b, a, lambda[0], other);
  for (const int i : {0, 6})
    for (const int j : {0, 6}) K.block<6, 6>(i, j) += other.block<6, 6>(6 - i, 6 - j);
}

constinit const ConstraintKind curve_on_curve_constraint = {.on_axis = true,
                                                            .holds = "distance of two curves"};

}  // namespace floatframe
