#include "floatframe/model/driven_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/math/cubic_spline.hpp"

namespace floatframe {

DrivenPath::DrivenPath(const std::vector<PathPoint>& points, bool closed) : closed_(closed) {
  std::vector<TablePoint> x, y;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n + (closed ? 1 : 0); ++i) {
    const PathPoint& p = points[i % n];
    if (i > 0) length_ += std::hypot(p.x - points[i - 1].x, p.y - points[i - 1].y);
    x.push_back({length_, p.x});
    y.push_back({length_, p.y});
  }
  const SplineEnds ends = closed ? SplineEnds::closed : SplineEnds::open;
  x_ = cubic_spline(x, ends);
  y_ = cubic_spline(y, ends);
}

DrivenPath DrivenPath::circle(const PathPoint& begin, double heading, double radius) {
  constexpr int n = 360;  // curvature within 1e-4
  // The centre is `radius` to the left of the beginning.
  const double cx = begin.x - radius * std::sin(heading), cy = begin.y + radius * std::cos(heading);
  std::vector<PathPoint> points;
  for (int k = 0; k < n; ++k) {
    const double angle = heading + std::copysign(2.0 * std::numbers::pi * k / n, radius);
    points.push_back({cx + radius * std::sin(angle), cy - radius * std::cos(angle)});
  }
  return DrivenPath(points, true);
}

DrivenPath DrivenPath::straight(const PathPoint& from, double heading) {
  return DrivenPath({from, {from.x + std::cos(heading), from.y + std::sin(heading)}});
}

namespace {

double third_derivative(const PiecewisePolynomial& f, double s) noexcept {
  const std::vector<double>& c = f.pieces()[f.piece_index(s)].coefficients;
  return c.size() > 3 ? 6.0 * c[3] : 0.0;
}

}  // namespace

DrivenPath::Value DrivenPath::at(double s) const noexcept {
  if (closed_) s = in_first_period(s, 0.0, length_);
  const PiecewisePolynomial::Value x = x_(s), y = y_(s);
  return {x.f, y.f, x.df, y.df, x.ddf, y.ddf, third_derivative(x_, s), third_derivative(y_, s)};
}

double DrivenPath::curvature(double s) const noexcept {
  const Value v = at(s);
  const double square = v.dx * v.dx + v.dy * v.dy;
  return (v.dx * v.ddy - v.dy * v.ddx) / (square * std::sqrt(square));
}

double DrivenPath::foot(double s, double x, double y) const noexcept {
  constexpr int most_steps = 30;
  for (int step = 0; step < most_steps; ++step) {
    const Value v = at(s);
    const double ex = x - v.x, ey = y - v.y, square = v.dx * v.dx + v.dy * v.dy;
    const double slope = std::max(square - ex * v.ddx - ey * v.ddy, 0.1 * square);
    const double whole = (ex * v.dx + ey * v.dy) / slope;
    // A curved path bends away within a step that is long.
    const bool straight = v.ddx == 0.0 && v.ddy == 0.0;
    const double widest = length_ / 16.0;
    const double ds = straight ? whole : std::clamp(whole, -widest, widest);
    s += ds;
    if (!(std::abs(ds) > 1e-14 * (std::abs(s) + length_))) break;
  }
  return s;
}

double DrivenPath::nearest(double x, double y) const noexcept {
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  const int samples = 4 * int(x_.breaks().size()) + 64;
  for (int k = 0; k <= samples; ++k) {
    const double s = length_ * k / samples;
    const Value v = at(s);
    if (const double d = std::hypot(x - v.x, y - v.y); d < least) least = d, best = s;
  }
  return foot(best, x, y);
}

}  // namespace floatframe
