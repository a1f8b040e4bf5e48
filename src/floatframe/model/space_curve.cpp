#include "floatframe/model/space_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/math/cubic_spline.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

SpaceCurve::SpaceCurve(const PointOnCurve& keys) : closed_(keys.closed) {
  int samples = 400;
  if (keys.points.rows() > 0) {
    std::vector<TablePoint> points[3];
    double length = 0.0;
    const Eigen::Index n = keys.points.rows(), all = n + (closed_ ? 1 : 0);
    for (Eigen::Index i = 0; i < all; ++i) {
      const Vec3 p = keys.points.row(i % n).transpose();
      if (i > 0) length += (p - keys.points.row(i - 1).transpose()).norm();
      for (int k = 0; k < 3; ++k) points[k].push_back({length, p[k]});
    }
    for (int k = 0; k < 3; ++k)
      pieces_[k] = cubic_spline(points[k], closed_ ? SplineEnds::closed : SplineEnds::open);
    last_ = length;
    samples = std::clamp<int>(8 * static_cast<int>(all), 400, 4000);
  } else {
    formulas_[0] = keys.x.value_or(nullptr);
    formulas_[1] = keys.y.value_or(nullptr);
    formulas_[2] = keys.z.value_or(nullptr);
    first_ = keys.range(0);
    last_ = keys.range(1);
  }
  for (int k = 0; k <= samples; ++k) {
    u_.push_back(first_ + (last_ - first_) * k / samples);
    samples_.push_back(at(u_.back()).c);
  }
  choose_normal();
}

void SpaceCurve::choose_normal() {
  std::vector<Vec3> tangents;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& c : samples_) mean += c / static_cast<double>(samples_.size());
  Mat3 spread = Mat3::Zero();
  for (std::size_t k = 0; k < u_.size(); ++k) {
    tangents.push_back(at(u_[k]).dc.normalized());
    spread += (samples_[k] - mean) * (samples_[k] - mean).transpose();
  }
  const SymmetricEigen eig = symmetric_eigen(spread);
  if (eig.values[1] > 1e-12 * eig.values[2] && eig.values[0] < 1e-13 * eig.values[2]) {
    normal_ = eig.vectors.col(0);
    return;
  }
  // Directions all over the half sphere: the one that is farthest from all tangents.
  constexpr int directions = 500;
  double best = -1.0;
  for (int k = 0; k < directions; ++k) {
    const double z = (k + 0.5) / directions, r = std::sqrt(1.0 - z * z);
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
    const Vec3 a(r * std::cos(turn), r * std::sin(turn), z);
    double nearest = 2.0;
    for (const Vec3& t : tangents) nearest = std::min(nearest, a.cross(t).norm());
    if (nearest > best) {
      best = nearest;
      normal_ = a;
    }
  }
}

SpaceCurve::Value SpaceCurve::at(double u) const noexcept {
  if (closed_) u = in_first_period(u, first_, last_ - first_);
  Value v;
  for (int k = 0; k < 3; ++k) {
    const PiecewisePolynomial::Value x =
        formulas_[k] ? formula_at(*formulas_[k], u) : pieces_[k](u);
    v.c[k] = x.f;
    v.dc[k] = x.df;
    v.ddc[k] = x.ddf;
  }
  return v;
}

double SpaceCurve::slowest() const {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const double u : u_) {
    const double speed = at(u).dc.norm();
    if (!std::isfinite(speed)) return 0.0;
    least = std::min(least, speed);
    most = std::max(most, speed);
  }
  return most > 0.0 ? least / most : 0.0;
}

SpaceCurve::Foot SpaceCurve::foot(const Vec3& p) const noexcept {
  std::size_t nearest = 0;
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < samples_.size(); ++k)
    if (const double s = (p - samples_[k]).squaredNorm(); s < square) {
      square = s;
      nearest = k;
    }
  const double u = foot_parameter(
      u_[nearest], u_[1] - u_[0], p, [&](double x) { return at(x); },
      [&](double x) { return !closed_ && (x <= first_ || x >= last_); });
  return curve_foot(u, p, at(u), normal_);
}

CurveFoot curve_foot(double u, const Vec3& p, const CurveValue& v, const Vec3& across) noexcept {
  CurveFoot f;
  f.u = u;
  f.e = p - v.c;
  f.dc = v.dc;
  f.ddc = v.ddc;
  f.slope = v.dc.squaredNorm() - f.e.dot(v.ddc);
  f.t = v.dc / v.dc.norm();
  f.u_p = v.dc / f.slope;
  f.n[1] = (across - across.dot(f.t) * f.t).normalized();
  f.n[0] = f.n[1].cross(f.t);
  turn_of_normals(f, across, f.ddc, f.n_u);
  return f;
}

void turn_of_normals(const CurveFoot& f, const Vec3& across, const Vec3& dc_rate,
                     Vec3 (&n_rate)[2]) noexcept {
  const Vec3 t_rate = (dc_rate - f.t * f.t.dot(dc_rate)) / f.dc.norm();
  const double size = (across - across.dot(f.t) * f.t).norm();
  const Vec3 w_rate = -across.dot(t_rate) * f.t - across.dot(f.t) * t_rate;
  n_rate[1] = (w_rate - f.n[1] * f.n[1].dot(w_rate)) / size;
  n_rate[0] = n_rate[1].cross(f.t) + f.n[1].cross(t_rate);
}

}  // namespace floatframe
