#pragma once
// A curve c(u) in the axes of a marker, by formulas of u or cubic splines over the length of its
// chords, open or closed, and what a point p has to do with it:
//   foot point   (p - c).c' = 0, of those nearest to p the nearest sample leads to one by Newton;
//                du = c'.dp / (c'.c' - e.c''),  e = p - c                                     (1)
//   frame        t = c'/|c'|, b along a without its part along t, n = b x t                   (2)
// with a direction a that t never has: the normal of the plane of a plane curve, where b = a. So n
// and b are smooth along the curve, and closed curves have the same ones at both ends.
//   n' = b' x t + b x t',  b' that of (2),  t' = (c'' - t t.c'') / |c'|                       (3)
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "floatframe/description/elements.hpp"

namespace floatframe {

/// Of a curve at u.
struct CurveValue {
  Vec3 c, dc, ddc;
};

/// What the point p sees of a curve, all in its axes.
struct CurveFoot {
  double u = 0.0;
  Vec3 e = Vec3::Zero();        ///< p - c
  Vec3 dc = Vec3::UnitX();      ///< c'
  Vec3 ddc = Vec3::Zero();      ///< c''
  double slope = 1.0;           ///< c'.c' - e.c'' of (1)
  Vec3 t = Vec3::UnitX();       ///< tangent
  Vec3 u_p = Vec3::UnitX();     ///< du/dp of (1)
  Vec3 n[2], n_u[2];            ///< n and b of (2), their derivatives (3)
  Vec3 dc_rate = Vec3::Zero();  ///< of c' at this u, of a curve that deforms [1/s]
  Vec3 n_rate[2] = {Vec3::Zero(),
                    Vec3::Zero()};  ///< and of n, by (3) with dc_rate in the place of c'' [1/s]
  /// du/dt of a point with the rate p_dot, against that of the curve at this u.
  double rate(const Vec3& p_dot) const noexcept { return u_p.dot(p_dot) + e.dot(dc_rate) / slope; }
};

/// The foot of p at u, where the curve has the value v; `across`: the direction a.
CurveFoot curve_foot(double u, const Vec3& p, const CurveValue& v, const Vec3& across) noexcept;
/// (3) with a rate of c' in the place of c''.
void turn_of_normals(const CurveFoot& f, const Vec3& across, const Vec3& dc_rate,
                     Vec3 (&n_rate)[2]) noexcept;

/// The u of (1) next to the given one, by Newton in steps of at most `widest`; with `straight(u)`
/// the curve is a line from there on, and steps are as long as they need to be.
template <class At, class Straight>
double foot_parameter(double u, double widest, const Vec3& p, const At& at,
                      const Straight& straight) noexcept {
  constexpr int most_steps = 30;
  CurveValue v = at(u);
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 e = p - v.c;
    const double slope = std::max(v.dc.squaredNorm() - e.dot(v.ddc), 0.1 * v.dc.squaredNorm());
    const double whole = e.dot(v.dc) / slope, du = std::clamp(whole, -widest, widest);
    u += straight(u) && v.ddc.isZero(0.0) ? whole : du;
    v = at(u);
    if (!(std::abs(du) > 1e-15 * (std::abs(u) + widest))) break;
  }
  return u;
}

class SpaceCurve {
 public:
  using Value = CurveValue;
  using Foot = CurveFoot;

  /// Allocates. Load time.
  explicit SpaceCurve(const PointOnCurve& keys);
  /// Step time.
  Value at(double u) const noexcept;
  Foot foot(const Vec3& p) const noexcept;
  /// Of the samples.
  const std::vector<double>& parameters() const noexcept { return u_; }
  /// Points along it, from its first to its last one.
  const std::vector<Vec3>& samples() const { return samples_; }
  /// The shortest |c'| of the samples, relative to the longest.
  double slowest() const;
  /// The direction a.
  const Vec3& across() const noexcept { return normal_; }
  bool closed() const noexcept { return closed_; }

 private:
  void choose_normal();

  PiecewisePolynomial pieces_[3];
  SharedFormula formulas_[3];
  double first_ = 0.0, last_ = 1.0;
  bool closed_ = false;
  std::vector<double> u_;
  std::vector<Vec3> samples_;
  Vec3 normal_ = Vec3::UnitZ();  ///< a
};

}  // namespace floatframe
