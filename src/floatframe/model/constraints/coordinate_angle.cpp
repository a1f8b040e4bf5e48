// An angle in a sum of coordinates, that of x_b from x_a about z, which is kept common to both
// markers by the other parts of the joint. With its factor c and the scale l of the row, of which
// this part may be one of several (ConstraintPart::continues):
//   phi        l (c q - f(t)), without f but in the first part; q = atan2(y_a.x_b, x_a.x_b), of its
//              turns the one nearest to `angle`                               1 row
//   gradient, quad and curvature: c times those of a prescribed angle (drive_angle.cpp)
#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::coordinate_angle>(const ConstraintPart& part,
                                                          const MarkerState& a,
                                                          const MarkerState& b, double t,
                                                          ConstraintRow* rows) noexcept {
  const double weight = part.scale * part.c;
  fill_angle_row(weight, a, b, *rows);
  rows->phi = weight * angle_about_z<double>(a, b, part.angle ? *part.angle : 0.0);
  subtract_motion(part, t, *rows);
}

template <>
void constraint_curvature_of<ConstraintType::coordinate_angle>(const ConstraintPart& part,
                                                               const MarkerState& a,
                                                               const MarkerState&,
                                                               const double* lambda,
                                                               Mat12& K) noexcept {
  add_angle_curvature(lambda[0] * part.scale * part.c, a, K);
}

constinit const ConstraintKind coordinate_angle_constraint = {
    .points = false, .on_axis = true, .holds = "sum of coordinates"};

}  // namespace floatframe
