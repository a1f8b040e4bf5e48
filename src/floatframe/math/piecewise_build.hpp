#pragma once
// Builders of piecewise polynomials: tables, joined polynomials, road profiles, sums.
//   linear:  straight lines between the points
//   cubic:   monotone cubic Hermite pieces (PCHIP: harmonic-mean slopes, Fritsch and Butland 1984),
//            C1, no overshoot
// Beyond the ends either the tangent or the end value is continued.
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "floatframe/math/piecewise_polynomial.hpp"

namespace floatframe {

struct TablePoint {
  double x = 0.0, f = 0.0;
};
enum class Interpolation { linear, cubic };
enum class Beyond { tangent, hold };

/// At least two points, x strictly ascending, else InputError. With `hold` the cubic has zero slope
/// at both ends, so it stays C1.
PiecewisePolynomial table_function(const std::vector<TablePoint>& points,
                                   Interpolation interpolation, Beyond beyond);

/// A table of time, constant beyond its ends. Two points with the same x are a jump to the value of
/// the second one: each side is interpolated separately. At least two points, x ascending and at
/// most two equal, else InputError.
/// With a period, which begins at the first point and which the points fill, it is not flat at its
/// ends: a cubic that ends at its first value has the slope of both sides there.
PiecewisePolynomial time_table(const std::vector<TablePoint>& points, Interpolation interpolation,
                               double period = 0.0);

/// Constant values from each x on, 0 before the first. At least one point, x strictly ascending,
/// else InputError.
PiecewisePolynomial step_function(const std::vector<TablePoint>& points);

/// The points from x0 to x1 fill a period, but for rounding.
bool fills_period(double x0, double x1, double period) noexcept;

/// x moved by whole periods to [first, first + period]. An x that is the sum of a break and of
/// whole periods comes to lie right of the break, in spite of rounding.
inline double in_first_period(double x, double first, double period) noexcept {
  const double right = x + 2.0 * std::numeric_limits<double>::epsilon() * std::abs(x);
  return right - period * std::floor((right - first) / period);
}

/// The pieces of f between its first break and a period later, repeated to cover [from, to], in at
/// most `most` pieces from the first of them on. f itself if the period is 0.
PiecewisePolynomial repeated(const PiecewisePolynomial& f, double period, double from, double to,
                             std::size_t most);

/// The continuous F with F' = f and F(x) = value.
PiecewisePolynomial integral(const PiecewisePolynomial& f, double x, double value);

/// Straight lines between points with x ascending; two equal x make a jump (to the value of the
/// second point at the jump). Flat beyond the ends. At least one point, else InputError.
PiecewisePolynomial profile_function(const std::vector<TablePoint>& points);

/// Sum of two functions; breaks are merged.
PiecewisePolynomial operator+(const PiecewisePolynomial& a, const PiecewisePolynomial& b);

/// stiffness (x - x0) on one side of x0, zero on the other.
PiecewisePolynomial ramp_below(double x0, double stiffness);
PiecewisePolynomial ramp_above(double x0, double stiffness);

/// Largest jump at a break, and the range of the function (largest minus smallest value between the
/// breaks widened on both sides by their span, or by the larger of |break| and 1 for a single
/// break).
struct JumpReport {
  double jump = 0.0, range = 0.0;
  std::size_t at = 0;  ///< index of the break
  bool continuous() const { return jump <= 1e-6 * range; }
};
JumpReport largest_jump(const PiecewisePolynomial& f);

}  // namespace floatframe
