// Distance: the points of a and b keep the distance L = `scale`. With d = r_b - r_a:
//   phi        (d.d - L^2) / (2 L) = 0                        1 row
//   gradient   -d/L on r_a, d/L on r_b
//   quad       ddot.ddot / L
//   curvature  d(d/L) = (dr_b - dr_a) / L
// Quadratic in d, so without a root; the gradient is a unit vector if phi = 0. The multiplier is
// then the force in the rod [N], tension positive.
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::distance>(const ConstraintPart& part, const MarkerState& a,
                                                  const MarkerState& b, double,
                                                  ConstraintRow* rows) noexcept {
  const Vec3 d = b.r - a.r;
  const Vec3 d_dot = b.v - a.v;
  const Vec3 n = d / part.scale;
  rows->phi = (d.squaredNorm() - part.scale * part.scale) / (2.0 * part.scale);
  rows->gradient = {-n, Vec3::Zero(), n, Vec3::Zero()};
  rows->quad = d_dot.squaredNorm() / part.scale;
  rows->phi_t = rows->phi_tt = 0.0;
}

template <>
void constraint_curvature_of<ConstraintType::distance>(const ConstraintPart& part,
                                                       const MarkerState&, const MarkerState&,
                                                       const double* lambda, Mat12& K) noexcept {
  using namespace part_of;
  const double weight = lambda[0] / part.scale;
  for (int k = 0; k < 3; ++k) {
    K(r_a + k, r_a + k) += weight;
    K(r_b + k, r_b + k) += weight;
    K(r_a + k, r_b + k) -= weight;
    K(r_b + k, r_a + k) -= weight;
  }
}

constinit const ConstraintKind distance_constraint = {.gradients = PartGradients::line,
                                                      .holds = "length"};

}  // namespace floatframe
