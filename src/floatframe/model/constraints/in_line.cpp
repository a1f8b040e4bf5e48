// In line: the point of b stays on the z axis of a. With d = r_b - r_a and x, y of a:
//   phi        x_a.d = 0, y_a.d = 0                           2 rows
//   gradients, quad and curvature: those along an axis that rotates with a (axis_row.hpp)
#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::in_line>(const ConstraintPart&, const MarkerState& a,
                                                 const MarkerState& b, double,
                                                 ConstraintRow* rows) noexcept {
  fill_axis_row(a.R.col(0), a, b, rows[0]);
  fill_axis_row(a.R.col(1), a, b, rows[1]);
}

template <>
void constraint_curvature_of<ConstraintType::in_line>(const ConstraintPart&, const MarkerState& a,
                                                      const MarkerState& b, const double* lambda,
                                                      Mat12& K) noexcept {
  add_axis_curvature(a.R.col(0), a, b, lambda[0], K);
  add_axis_curvature(a.R.col(1), a, b, lambda[1], K);
}

constinit const ConstraintKind in_line_constraint = {.rows = 2};

}  // namespace floatframe
