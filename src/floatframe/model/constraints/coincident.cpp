// Coincident: the point of b is that of a.
//   phi        d = r_b - r_a = 0                              3 rows, world axes
//   gradients  unit vectors: -e_k on r_a, e_k on r_b
//   quad       0, since the gradients are constant; so is the curvature
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::coincident>(const ConstraintPart&, const MarkerState& a,
                                                    const MarkerState& b, double,
                                                    ConstraintRow* rows) noexcept {
  for (int k = 0; k < 3; ++k) {
    rows[k].phi = b.r[k] - a.r[k];
    rows[k].gradient = {-Vec3::Unit(k), Vec3::Zero(), Vec3::Unit(k), Vec3::Zero()};
    rows[k].quad = rows[k].phi_t = rows[k].phi_tt = 0.0;
  }
}

template <>
void constraint_curvature_of<ConstraintType::coincident>(const ConstraintPart&, const MarkerState&,
                                                         const MarkerState&, const double*,
                                                         Mat12&) noexcept {}

constinit const ConstraintKind coincident_constraint = {.rows = 3,
                                                        .gradients = PartGradients::unit};

}  // namespace floatframe
