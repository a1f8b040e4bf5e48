#pragma once
// A curve c(u) in the axes of a marker, by formulas of u or cubic splines over the length of its
// chords, open or closed, and what a point p has to do with it:
//   foot point   (p - c).c' = 0, of those nearest to p the nearest sample leads to one by Newton;
//                du = c'.dp / (c'.c' - e.c''),  e = p - c                                     (1)
//   frame        t = c'/|c'|, b along a without its part along t, n = b x t                   (2)
// with a direction a that t never has: the normal of the plane of a plane curve, where b = a. So n
// and b are smooth along the curve, and closed curves have the same ones at both ends.
//   n' = b' x t + b x t',  b' that of (2),  t' = (c'' - t t.c'') / |c'|                       (3)
#include <memory>
#include <vector>

#include "floatframe/description/elements.hpp"

namespace floatframe {

class SpaceCurve {
 public:
  struct Value {
    Vec3 c, dc, ddc;
  };
  /// What the point p sees of the curve, all in its axes.
  struct Foot {
    double u = 0.0;
    Vec3 e;             ///< p - c
    Vec3 t, u_p;        ///< tangent, du/dp of (1)
    Vec3 n[2], n_u[2];  ///< n and b of (2), their derivatives (3)
  };

  /// Allocates. Load time.
  explicit SpaceCurve(const PointOnCurve& keys);
  /// Step time.
  Value at(double u) const noexcept;
  Foot foot(const Vec3& p) const noexcept;
  /// Points along it, from its first to its last one.
  const std::vector<Vec3>& samples() const { return samples_; }
  /// The shortest |c'| of the samples, relative to the longest.
  double slowest() const;

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
