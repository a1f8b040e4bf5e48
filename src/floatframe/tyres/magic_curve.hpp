#pragma once
// Pieces of the Magic Formula over a scalar S, double or dual number; another one, B, is that of
// what the slips do not change, and E of either:
//   argument   A(x) = B x - E (B x - atan(B x))
//   force      D sin(C atan A),   weight and trail   cos(C atan A)
// E is limited to 1: above, the curve would turn back. Source: H. B. Pacejka, Tire and Vehicle
// Dynamics, 3rd ed. 2012, equations 4.E9 - 4.E78.
#include <cmath>
#include <numbers>

#include "floatframe/math/dual.hpp"

namespace floatframe {

inline double arctan(double x) noexcept { return std::atan(x); }
template <int n>
DualNumber<n> arctan(const DualNumber<n>& x) noexcept {
  return chained(std::atan(x.v), 1.0 / (1.0 + x.v * x.v), x);
}

/// cos(atan(x)).
template <class S>
S cos_of_arctan(const S& x) noexcept {
  using std::sqrt;
  return 1.0 / sqrt(S(1.0 + x * x));
}

/// A value that stays within limits; beyond them it is constant.
template <class S>
S within(const S& x, double least, double most) noexcept {
  return value_of(x) < least ? S(least) : value_of(x) > most ? S(most) : x;
}

template <class S>
S at_least(const S& x, double least) noexcept {
  return value_of(x) >= least ? x : S(least);
}

/// -1 or 1, and 1 at zero: a reversal of the curvature, which changes no slope at zero slip.
template <class S>
double side_of(const S& x) noexcept {
  return value_of(x) < 0.0 ? -1.0 : 1.0;
}

/// The sign of x, from -width to width x^3 (10 - 15 |x| + 6 x^2) of x/width: without a slope at 0.
template <class S>
S smooth_sign(const S& x, double width) noexcept {
  using std::abs;
  if (!(std::abs(value_of(x)) < width)) return side_of(x);
  const S y = x / width;
  return y * y * y * (10.0 - 15.0 * abs(y) + 6.0 * y * y);
}

/// a0 + a1 x.
template <class S>
S line(const double (&a)[2], const S& x) noexcept {
  return a[0] + a[1] * x;
}
/// a0 + a1 x + a2 x^2.
template <class S>
S parabola(const double (&a)[3], const S& x) noexcept {
  return a[0] + (a[1] + a[2] * x) * x;
}

/// B x - E (B x - atan(B x)), E at most 1.
template <class S, class B>
S magic_argument(const S& Bx, const B& E) noexcept {
  if (value_of(E) > 1.0) return arctan(Bx);
  return Bx - E * (Bx - arctan(Bx));
}
/// sin(C atan(B x - E (B x - atan(B x)))).
template <class S, class B>
S magic_sine(double C, const S& Bx, const B& E) noexcept {
  using std::sin;
  return sin(S(C * arctan(magic_argument(Bx, E))));
}
/// cos(C atan(B x - E (B x - atan(B x)))).
template <class S, class B>
S magic_cosine(double C, const S& Bx, const B& E) noexcept {
  using std::cos;
  return cos(S(C * arctan(magic_argument(Bx, E))));
}

/// sin(p atan(x))/x, also at x = 0, where it is p.
template <class S>
S sine_over(double p, const S& x) noexcept {
  using std::sin;
  if (p == 2.0) return 2.0 / (1.0 + x * x);
  // p (1 - x^2 (2 + p^2)/6 + O(x^4)) is exact to rounding below.
  if (std::abs(value_of(x)) < 1e-4) return p * (1.0 - (2.0 + p * p) / 6.0 * x * x);
  return sin(S(p * arctan(x))) / x;
}

}  // namespace floatframe
