// Prescribed displacement: the point of b is f(t) along e = R_a e_a. With d = r_b - r_a:
//   phi        e.d - f(t) = 0                                1 row
//   gradient, quad and curvature: those along an axis that rotates with a (axis_row.hpp)
//   in time    phi_t = -fdot, phi_tt = -fddot
#include <cassert>

#include "floatframe/model/axis_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::drive_position>(const ConstraintPart& part,
                                                        const MarkerState& a, const MarkerState& b,
                                                        double t, ConstraintRow* rows) noexcept {
  fill_axis_row(a.R * part.e_a, a, b, *rows);
  assert(part.motion);
  const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
  rows->phi -= f.f;
  rows->phi_t = -f.df;
  rows->phi_tt = -f.ddf;
}

template <>
void constraint_curvature_of<ConstraintType::drive_position>(const ConstraintPart& part,
                                                             const MarkerState& a,
                                                             const MarkerState& b,
                                                             const double* lambda,
                                                             Mat12& K) noexcept {
  add_axis_curvature(a.R * part.e_a, a, b, lambda[0], K);
}

constinit const ConstraintKind drive_position_constraint = {.holds = "prescribed motion"};

}  // namespace floatframe
