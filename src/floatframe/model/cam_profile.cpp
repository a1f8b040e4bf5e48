#include "floatframe/model/cam_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/math/cubic_spline.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

PiecewisePolynomial::Value cam_rise(CamLaw law, double u) noexcept {
  constexpr double pi = std::numbers::pi;
  const double u2 = u * u, u3 = u2 * u, v = 1.0 - u;
  switch (law) {
    case CamLaw::harmonic:
      return {0.5 * (1.0 - std::cos(pi * u)), 0.5 * pi * std::sin(pi * u),
              0.5 * pi * pi * std::cos(pi * u)};
    case CamLaw::cycloidal:
      return {u - std::sin(2.0 * pi * u) / (2.0 * pi), 1.0 - std::cos(2.0 * pi * u),
              2.0 * pi * std::sin(2.0 * pi * u)};
    case CamLaw::polynomial_345:
      return {u3 * (10.0 - 15.0 * u + 6.0 * u2), 30.0 * u2 * v * v, 60.0 * u * v * (1.0 - 2.0 * u)};
    case CamLaw::polynomial_4567:
      return {u2 * u2 * (35.0 - 84.0 * u + 70.0 * u2 - 20.0 * u3), 140.0 * u3 * v * v * v,
              420.0 * u2 * v * v * (1.0 - 2.0 * u)};
  }
  return {};
}

PiecewisePolynomial::Value CamProfile::operator()(double coordinate) const noexcept {
  double x = coordinate - phase;
  if (formula) return formula_at(*formula, x);
  if (period > 0.0) x = in_first_period(x, spline ? pieces.breaks().front() : 0.0, period);
  if (spline) return pieces(x);
  assert(ends.size() == lifts.size() && !ends.empty());
  const auto after = std::upper_bound(ends.begin(), ends.end(), x);
  if (after == ends.begin()) return {lifts.front(), 0.0, 0.0};
  if (after == ends.end()) return {lifts.back(), 0.0, 0.0};
  const std::size_t k = after - ends.begin();
  const double width = ends[k] - ends[k - 1], rise = lifts[k] - lifts[k - 1];
  const PiecewisePolynomial::Value r = cam_rise(law, (x - ends[k - 1]) / width);
  return {lifts[k - 1] + rise * r.f, rise * r.df / width, rise * r.ddf / (width * width)};
}

bool cam_fills_turn(double x0, double x1) { return fills_period(x0, x1, 2.0 * std::numbers::pi); }

CamProfile cam_profile(const Cam& keys, bool turns) {
  CamProfile p;
  p.phase = keys.phase;
  p.law = keys.law;
  p.formula = keys.formula.value_or(nullptr);
  if (p.formula) return p;
  p.spline = keys.points.rows() > 0;
  const MatX& rows = p.spline ? keys.points : keys.segments;
  const Eigen::Index n = rows.rows();
  const double first = p.spline ? rows(0, 0) : 0.0;
  if (turns && cam_fills_turn(first, rows(n - 1, 0))) p.period = rows(n - 1, 0) - first;
  if (!p.spline) {
    for (Eigen::Index i = 0; i < n; ++i) {
      p.ends.push_back(rows(i, 0));
      p.lifts.push_back(p.lifts.back() + rows(i, 1));
    }
    return p;
  }
  std::vector<TablePoint> points;
  for (Eigen::Index i = 0; i < n; ++i) points.push_back({rows(i, 0), rows(i, 1)});
  if (p.period > 0.0) points.back().f = points.front().f;
  p.pieces = cubic_spline(points, p.period > 0.0 ? SplineEnds::closed : SplineEnds::open);
  return p;
}

double CamProfile::steepest() const {
  constexpr int samples = 2000;
  double from = low, to = high, most = 0.0;
  if (!formula) {
    from = spline ? pieces.breaks().front() : ends.front();
    to = spline ? pieces.breaks().back() : ends.back();
  }
  for (int k = 0; k <= samples; ++k) {
    const double slope = std::abs((*this)(phase + from + (to - from) * k / samples).df);
    if (std::isfinite(slope)) most = std::max(most, slope);
  }
  return most;
}

}  // namespace floatframe
