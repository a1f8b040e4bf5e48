#pragma once
// Builders of piecewise polynomials: tables, joined polynomials, road profiles, sums.
//   linear:  straight lines between the points
//   cubic:   monotone cubic Hermite pieces (PCHIP: harmonic-mean slopes, Fritsch and Butland 1984),
//            C1, no overshoot
// Beyond the ends either the tangent or the end value is continued.
#include <cstddef>
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
PiecewisePolynomial time_table(const std::vector<TablePoint>& points, Interpolation interpolation);

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
