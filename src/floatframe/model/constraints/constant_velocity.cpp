// Constant velocity: the shaft of b, along z_b, is that of a, along z_a, tilted and not twisted:
// the rotation from a to b is one about a normal of z_a. Of the rotation vector u of R_a^T R_b that
// is u_z = 0, where the matrix is symmetric in its rows and columns 1 and 2. Shafts in bearings
// that stand still then turn by the same angle: with a relative angle d and the angle g between
// them
//   x_b.y_a - x_a.y_b = sin(d) (1 + cos(g))
// The row is scaled by half a body length l:
//   phi        l/2 (y_a.x_b - x_a.y_b)                        1 row
//   gradient, quad and curvature: the sum of those of two directions (perpendicular.cpp)
#include "floatframe/model/direction_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::constant_velocity>(const ConstraintPart& part,
                                                           const MarkerState& a,
                                                           const MarkerState& b, double,
                                                           ConstraintRow* rows) noexcept {
  const double weight = 0.5 * part.scale;
  clear_row(*rows);
  add_direction_row(weight, a.R.col(1), b.R.col(0), a, b, *rows);
  add_direction_row(-weight, a.R.col(0), b.R.col(1), a, b, *rows);
}

template <>
void constraint_curvature_of<ConstraintType::constant_velocity>(const ConstraintPart& part,
                                                                const MarkerState& a,
                                                                const MarkerState& b,
                                                                const double* lambda,
                                                                Mat12& K) noexcept {
  const double weight = 0.5 * part.scale * lambda[0];
  add_direction_curvature(weight, a.R.col(1), b.R.col(0), K);
  add_direction_curvature(-weight, a.R.col(0), b.R.col(1), K);
}

constinit const ConstraintKind constant_velocity_constraint = {.points = false,
                                                               .holds = "twist of the shafts"};

}  // namespace floatframe
