#pragma once
// Two plane curves that touch: p(u) in the axes of a marker a and q(w) in those of b, in planes
// normal to the axis k. In the axes of a, with R the orientation and d the point of b and
//   D = d + R q - p,  t = p'/|p'|,  n = k x t,
// the parameters of the contact have a common tangent and normal:
//   g_1 = t.D = 0,   g_2 = n.R q' = 0                                                          (1)
// Newton on (1) begins at the best pair of samples: b is convex, so that its table of tangent
// angles gives a w for each sample u of a. Nothing is remembered from one evaluation to the next.
// With kappa the curvature of a and kappa_b that of b against the same normal the contact is the
// only one, and goes on smoothly, if kappa > kappa_b at all pairs or kappa < kappa_b at all.
#include "floatframe/model/space_curve.hpp"

namespace floatframe {

/// From the least to the largest value over the samples of a curve.
struct CurvatureRange {
  double low, high;
  bool one_sign() const noexcept { return low > 0.0 || high < 0.0; }
};
CurvatureRange curvatures(const SpaceCurve& curve, const Vec3& k);

class CurveContact {
 public:
  /// The contact, in the axes of a.
  struct Point {
    Vec3 n, t;     ///< of (1)
    Vec3 q, dq;    ///< R q, R q'
    double phi;    ///< n.D
    double speed;  ///< |p'|
    double turn;   ///< kappa |p'|
    double along;  ///< t.R q'
    double bend;   ///< n.R q''
  };

  /// Of the curves of two markers. `same`: their tangents have the same sense where they touch. If
  /// only the first one has a curvature of one sign, they are swapped. Allocates. Load time.
  CurveContact(const SpaceCurve& one, const SpaceCurve& two, const Vec3& k, bool same);
  /// Step time.
  Point at(const Mat3& R, const Vec3& d) const noexcept;
  /// a is the second marker, b the first one.
  bool swapped() const noexcept { return swapped_; }
  /// That of the first or second marker.
  const SpaceCurve& curve(bool second) const noexcept { return second == swapped_ ? a_ : b_; }

 private:
  struct Start {
    double u = 0.0, w = 0.0, size = 0.0;
    bool crosses = false;
  };
  Start begin(const Mat3& R, const Vec3& d) const noexcept;
  /// The entry of the table for an angle of the tangent of b; -1: it has none there.
  int entry(double angle) const noexcept;

  bool swapped_;
  SpaceCurve a_, b_;
  Vec3 k_, e1_, e2_;
  double sense_;                         ///< 1 or -1
  std::vector<Vec3> points_, tangents_;  ///< of the samples of a
  std::vector<double> angles_;           ///< of the tangents
  double first_angle_ = 0.0, last_angle_ = 0.0;
  bool whole_ = false;     ///< b turns by 2 pi
  std::vector<double> w_;  ///< over equal steps of the angle of the tangent of b
  std::vector<Vec3> q_;
};

}  // namespace floatframe
