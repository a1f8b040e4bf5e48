// A displacement in a sum of coordinates: with d = r_b - r_a, e_a fixed in a, its factor c and the
// scale l of the row, of which this part may be one of several (ConstraintPart::continues):
//   phi        l (c e_a.d - f(t)), without f but in the first part            1 row
//   gradient, quad and curvature: l c times those along an axis that rotates with a (axis_row.hpp)
#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::coordinate_displacement>(const ConstraintPart& part,
                                                                 const MarkerState& a,
                                                                 const MarkerState& b, double t,
                                                                 ConstraintRow* rows) noexcept {
  const double weight = part.scale * part.c;
  fill_axis_row(weight * (a.R * part.e_a), a, b, *rows);
  subtract_motion(part, t, *rows);
}

template <>
void constraint_curvature_of<ConstraintType::coordinate_displacement>(const ConstraintPart& part,
                                                                      const MarkerState& a,
                                                                      const MarkerState& b,
                                                                      const double* lambda,
                                                                      Mat12& K) noexcept {
  add_axis_curvature(a.R * part.e_a, a, b, lambda[0] * part.scale * part.c, K);
}

constinit const ConstraintKind coordinate_displacement_constraint = {.holds = "sum of coordinates"};

}  // namespace floatframe
