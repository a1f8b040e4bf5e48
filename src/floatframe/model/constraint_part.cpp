#include "floatframe/model/constraint_part.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/axis_measure.hpp"

namespace floatframe {

PiecewisePolynomial::Value evaluate(const TimeFunction& f, double t) noexcept {
  PiecewisePolynomial::Value v = f.pieces(t);
  if (f.amplitude != 0.0) {
    const double w = 2.0 * std::numbers::pi * f.frequency;
    const double s = std::sin(w * t + f.phase), c = std::cos(w * t + f.phase);
    v.f += f.amplitude * s;
    v.df += f.amplitude * w * c;
    v.ddf -= f.amplitude * w * w * s;
  }
  return v;
}

namespace {

using Kind = ConstraintPart::Kind;
using namespace part_of;

void coincident(const ConstraintPart&, const MarkerState& a, const MarkerState& b, double,
                ConstraintRow* rows) noexcept {
  for (int k = 0; k < 3; ++k) {
    rows[k].phi = b.r[k] - a.r[k];
    rows[k].gradient = {-Vec3::Unit(k), Vec3::Zero(), Vec3::Unit(k), Vec3::Zero()};
    rows[k].quad = rows[k].phi_t = rows[k].phi_tt = 0.0;
  }
}

void coincident_curvature(const ConstraintPart&, const MarkerState&, const MarkerState&,
                          const double*, Mat12&) noexcept {}

/// phi = n.d with n fixed in a.
void axis_row(const Vec3& n, const MarkerState& a, const MarkerState& b,
              ConstraintRow& row) noexcept {
  const AxisMeasure m = axis_measure(n, a, b);
  row.phi = m.s;
  row.gradient = m.g;
  const Vec3 n_dot = a.w.cross(n);
  row.quad = a.w.cross(n_dot).dot(b.r - a.r) + 2.0 * n_dot.dot(b.v - a.v);
  row.phi_t = row.phi_tt = 0.0;
}

void in_line(const ConstraintPart&, const MarkerState& a, const MarkerState& b, double,
             ConstraintRow* rows) noexcept {
  axis_row(a.R.col(0), a, b, rows[0]);
  axis_row(a.R.col(1), a, b, rows[1]);
}

void in_line_curvature(const ConstraintPart&, const MarkerState& a, const MarkerState& b,
                       const double* lambda, Mat12& K) noexcept {
  add_axis_curvature(a.R.col(0), a, b, lambda[0], K);
  add_axis_curvature(a.R.col(1), a, b, lambda[1], K);
}

void in_plane(const ConstraintPart&, const MarkerState& a, const MarkerState& b, double,
              ConstraintRow* rows) noexcept {
  axis_row(a.R.col(2), a, b, rows[0]);
}

void in_plane_curvature(const ConstraintPart&, const MarkerState& a, const MarkerState& b,
                        const double* lambda, Mat12& K) noexcept {
  add_axis_curvature(a.R.col(2), a, b, lambda[0], K);
}

void perpendicular(const ConstraintPart& part, const MarkerState& a, const MarkerState& b, double,
                   ConstraintRow* rows) noexcept {
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  const Vec3 torque = part.scale * e.cross(n);
  rows->phi = part.scale * (e.dot(n) - part.c);
  rows->gradient = {Vec3::Zero(), torque, Vec3::Zero(), -torque};
  const Vec3 e_dot = a.w.cross(e);
  const Vec3 n_dot = b.w.cross(n);
  rows->quad =
      part.scale * (a.w.cross(e_dot).dot(n) + 2.0 * e_dot.dot(n_dot) + e.dot(b.w.cross(n_dot)));
  rows->phi_t = rows->phi_tt = 0.0;
}

/// d(e x n) = (e n^T - e.n I) dpi_a + (e.n I - n e^T) dpi_b
void perpendicular_curvature(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                             const double* lambda, Mat12& K) noexcept {
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  const double weight = lambda[0] * part.scale;
  Mat3 by_a = weight * e * n.transpose(), by_b = -weight * n * e.transpose();
  by_a.diagonal().array() -= weight * e.dot(n);
  by_b.diagonal().array() += weight * e.dot(n);
  K.block<3, 3>(pi_a, pi_a) += by_a;
  K.block<3, 3>(pi_a, pi_b) += by_b;
  K.block<3, 3>(pi_b, pi_a) -= by_a;
  K.block<3, 3>(pi_b, pi_b) -= by_b;
}

void distance(const ConstraintPart& part, const MarkerState& a, const MarkerState& b, double,
              ConstraintRow* rows) noexcept {
  const Vec3 d = b.r - a.r;
  const Vec3 d_dot = b.v - a.v;
  const Vec3 n = d / part.scale;
  rows->phi = (d.squaredNorm() - part.scale * part.scale) / (2.0 * part.scale);
  rows->gradient = {-n, Vec3::Zero(), n, Vec3::Zero()};
  rows->quad = d_dot.squaredNorm() / part.scale;
  rows->phi_t = rows->phi_tt = 0.0;
}

void distance_curvature(const ConstraintPart& part, const MarkerState&, const MarkerState&,
                        const double* lambda, Mat12& K) noexcept {
  const double weight = lambda[0] / part.scale;
  for (int k = 0; k < 3; ++k) {
    K(r_a + k, r_a + k) += weight;
    K(r_b + k, r_b + k) += weight;
    K(r_a + k, r_b + k) -= weight;
    K(r_b + k, r_a + k) -= weight;
  }
}

void drive_position(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                    double t, ConstraintRow* rows) noexcept {
  axis_row(a.R.col(2), a, b, *rows);
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  rows->phi -= f.f;
  rows->phi_t = -f.df;
  rows->phi_tt = -f.ddf;
}

void drive_position_curvature(const ConstraintPart&, const MarkerState& a, const MarkerState& b,
                              const double* lambda, Mat12& K) noexcept {
  add_axis_curvature(a.R.col(2), a, b, lambda[0], K);
}

void drive_angle(const ConstraintPart& part, const MarkerState& a, const MarkerState& b, double t,
                 ConstraintRow* rows) noexcept {
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  const Vec3 x = b.R.col(0);
  const Vec3 z = a.R.col(2);
  const double angle = std::atan2(x.dot(a.R.col(1)), x.dot(a.R.col(0)));
  rows->phi = part.scale * std::remainder(angle - f.f, 2.0 * std::numbers::pi);
  rows->gradient = {Vec3::Zero(), -part.scale * z, Vec3::Zero(), part.scale * z};
  rows->quad = part.scale * a.w.cross(z).dot(b.w - a.w);
  rows->phi_t = -part.scale * f.df;
  rows->phi_tt = -part.scale * f.ddf;
}

void drive_angle_curvature(const ConstraintPart& part, const MarkerState& a, const MarkerState&,
                           const double* lambda, Mat12& K) noexcept {
  const Mat3 Z = lambda[0] * part.scale * skew(a.R.col(2));  // dz = -skew(z) dpi_a
  K.block<3, 3>(pi_a, pi_a) += Z;
  K.block<3, 3>(pi_b, pi_a) -= Z;
}

// In the order of ConstraintPart::Kind. Only the angle of a hinge asks that the markers share the
// axis, which the other parts of the joint see to.
constexpr ConstraintKind kinds[] = {
    {Kind::coincident, "coincident", false, coincident, coincident_curvature},
    {Kind::in_line, "in_line", false, in_line, in_line_curvature},
    {Kind::in_plane, "in_plane", false, in_plane, in_plane_curvature},
    {Kind::perpendicular, "perpendicular", false, perpendicular, perpendicular_curvature},
    {Kind::distance, "distance", false, distance, distance_curvature},
    {Kind::drive_position, "drive_position", false, drive_position, drive_position_curvature},
    {Kind::drive_angle, "drive_angle", true, drive_angle, drive_angle_curvature}};

}  // namespace

std::span<const ConstraintKind> constraint_kinds() noexcept { return kinds; }

namespace {

/// Calls f with the kind's entry as a constant: comparisons and direct calls, no pointer.
template <class F, std::size_t... I>
void with_kind(Kind kind, std::index_sequence<I...>, F f) noexcept {
  ((kind == kinds[I].kind ? f(std::integral_constant<std::size_t, I>{}) : void()), ...);
}

constexpr std::make_index_sequence<std::size(kinds)> all_kinds;

}  // namespace

void evaluate_constraint(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                         double t, ConstraintRow* rows) noexcept {
  with_kind(part.kind, all_kinds, [&](auto i) { kinds[i].evaluate(part, a, b, t, rows); });
}

void add_constraint_curvature(const ConstraintPart& part, const MarkerState& a,
                              const MarkerState& b, const double* lambda, Mat12& K) noexcept {
  with_kind(part.kind, all_kinds, [&](auto i) { kinds[i].curvature(part, a, b, lambda, K); });
}

}  // namespace floatframe
