#pragma once
// Cubic splines: through the points, with continuous slope and curvature. On knots x_i with
// h_i = x_{i+1} - x_i and second derivatives M_i,
//   h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (d_i - d_{i-1}),              (1)
//   d_i = (f_{i+1} - f_i) / h_i
// open: the third derivative does not jump at the second and the last knot but one (de Boor 1978);
// closed: slope and curvature at both ends are the same. The error of the curvature falls with h^2.
#include <vector>

#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

enum class SplineEnds { open, closed };

/// At least two points, x strictly ascending, else InputError; closed: at least three, f equal at
/// both ends. Beyond the ends it goes on along its tangents.
PiecewisePolynomial cubic_spline(const std::vector<TablePoint>& points, SplineEnds ends);

}  // namespace floatframe
