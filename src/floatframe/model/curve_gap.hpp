#pragma once
// Gaps of a curve c(u): halving finds where the change between two parameters is not that of the
// slopes,
//   |c(b) - c(a) - h (c'(a) + c'(b)) / 2| > h (|c'(a)| + |c'(b)|) / 4,  h = b - a,  (1)
// down to neighbouring numbers. A change that is left there is a gap; where numbers end or grow
// without bound the curve has an end. Load time only.
#include <cmath>
#include <limits>
#include <optional>

#include "floatframe/model/space_curve.hpp"

namespace floatframe {

struct CurveGap {
  double at = 0.0;
  double size = 0.0;  ///< infinite: an end
};

/// The gap between two samples of `at(u)`, a CurveValue; smaller ones are rounding.
template <class At>
std::optional<CurveGap> gap_between(double a, double b, double smallest, const At& at) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto finite = [](const CurveValue& v) { return v.c.allFinite() && v.dc.allFinite(); };
  CurveValue A = at(a), B = at(b);
  const auto rest = [](double h, const CurveValue& p, const CurveValue& q) -> double {
    return (q.c - p.c - 0.5 * h * (p.dc + q.dc)).norm();
  };
  while (finite(A) || finite(B)) {
    const bool both = finite(A) && finite(B);
    if (both && !(rest(b - a, A, B) > 0.25 * (b - a) * (A.dc.norm() + B.dc.norm())))  // (1)
      return std::nullopt;
    const double middle = a + 0.5 * (b - a);
    if (!(middle > a && middle < b)) break;
    const CurveValue M = at(middle);
    const bool left = !finite(M)   ? finite(A)
                      : !finite(A) ? true
                      : !finite(B) ? false
                                   : rest(middle - a, A, M) > rest(b - middle, M, B);
    (left ? b : a) = middle;
    (left ? B : A) = M;
  }
  if (!finite(A)) return CurveGap{b, none};
  if (!finite(B)) return CurveGap{a, none};
  constexpr double unbounded = 1e9;
  if (!(A.c.norm() < unbounded && B.c.norm() < unbounded)) return CurveGap{b, none};
  const double size = (B.c - A.c).norm();
  return size > smallest ? std::optional(CurveGap{b, size}) : std::nullopt;
}

}  // namespace floatframe
