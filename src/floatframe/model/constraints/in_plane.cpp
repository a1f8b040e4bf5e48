// In plane: the point of b stays in the xy plane of a. With d = r_b - r_a:
//   phi        z_a.d = 0                                      1 row
//   gradient, quad and curvature: those along an axis that rotates with a (axis_row.hpp)
#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::in_plane>(const ConstraintPart&, const MarkerState& a,
                                                  const MarkerState& b, double,
                                                  ConstraintRow* rows) noexcept {
  fill_axis_row(a.R.col(2), a, b, rows[0]);
}

template <>
void constraint_curvature_of<ConstraintType::in_plane>(const ConstraintPart&, const MarkerState& a,
                                                       const MarkerState& b, const double* lambda,
                                                       Mat12& K) noexcept {
  add_axis_curvature(a.R.col(2), a, b, lambda[0], K);
}

constinit const ConstraintKind in_plane_constraint = {};

}  // namespace floatframe
