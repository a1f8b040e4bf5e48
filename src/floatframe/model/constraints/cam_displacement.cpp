// The lift of a cam that slides (a template), a term of a row that begins with its follower: with
// x = c q, q = e_a.d, d = r_b - r_a, e_a fixed in a, the lift s(x) (cam_profile.hpp) and the scale
// l of the row:
//   phi        -l s(x)                                       1 row, which continues another
//   gradient   -l s' c g, g that along an axis that rotates with a (axis_row.hpp)
//   quad       -l (s' c quad_q + s'' (c qdot)^2)
//   curvature  -l (s' c dg + s'' c^2 g g^T)
#include <cassert>

#include "floatframe/model/axis_row.hpp"
#include "floatframe/model/cam_profile.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::cam_displacement>(const ConstraintPart& part,
                                                          const MarkerState& a,
                                                          const MarkerState& b, double,
                                                          ConstraintRow* rows) noexcept {
  assert(part.lift);
  const Vec3 e = a.R * part.e_a;
  const AxisMeasure<double> m = axis_measure(e, a, b);
  const PiecewisePolynomial::Value s = (*part.lift)(part.c * m.s);
  fill_axis_row((-part.scale * s.df * part.c) * e, a, b, *rows);
  rows->phi = -part.scale * s.f;
  rows->quad -= part.scale * s.ddf * part.c * part.c * m.rate * m.rate;
}

template <>
void constraint_curvature_of<ConstraintType::cam_displacement>(const ConstraintPart& part,
                                                               const MarkerState& a,
                                                               const MarkerState& b,
                                                               const double* lambda,
                                                               Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 e = a.R * part.e_a;
  const AxisMeasure<double> m = axis_measure(e, a, b);
  const PiecewisePolynomial::Value s = (*part.lift)(part.c * m.s);
  add_axis_curvature(e, a, b, -lambda[0] * part.scale * s.df * part.c, K);
  Vec12 g = Vec12::Zero();
  g.segment<3>(r_a) = m.g.a.F;
  g.segment<3>(pi_a) = m.g.a.T;
  g.segment<3>(r_b) = m.g.b.F;
  K += (-lambda[0] * part.scale * s.ddf * part.c * part.c) * g * g.transpose();
}

constinit const ConstraintKind cam_displacement_constraint = {.holds = "lift of a cam"};

}  // namespace floatframe
