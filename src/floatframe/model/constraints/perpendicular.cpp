// Perpendicular: a direction e = R_a e_a of a and a direction n = R_b n_b of b keep the product c
// (0: a right angle). The row is scaled by a body length l.
//   phi        l (e.n - c) = 0                                1 row
//   gradient, quad and curvature: l times those of two directions (direction_row.hpp)
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/direction_row.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::perpendicular>(const ConstraintPart& part,
                                                       const MarkerState& a, const MarkerState& b,
                                                       double, ConstraintRow* rows) noexcept {
  assert(is_unit(part.e_a) && is_unit(part.n_b) && std::abs(part.c) <= 1.0);
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  clear_row(*rows);
  add_direction_row(part.scale, e, n, a, b, *rows);
  rows->phi = part.scale * (e.dot(n) - part.c);
}

template <>
void constraint_curvature_of<ConstraintType::perpendicular>(const ConstraintPart& part,
                                                            const MarkerState& a,
                                                            const MarkerState& b,
                                                            const double* lambda,
                                                            Mat12& K) noexcept {
  const Vec3 e = a.R * part.e_a;
  const Vec3 n = b.R * part.n_b;
  add_direction_curvature(lambda[0] * part.scale, e, n, K);
}

constinit const ConstraintKind perpendicular_constraint = {.points = false};

}  // namespace floatframe
