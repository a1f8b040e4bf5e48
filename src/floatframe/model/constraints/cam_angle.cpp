// The lift of a cam that turns, a term of a row that begins with its follower: with x = c q,
// q = atan2(y_a.x_b, x_a.x_b) counted over turns (coordinate_angle.cpp), the lift s(x)
// (cam_profile.hpp) and the scale l of the row:
//   phi        -l s(x)                                       1 row, which continues another
//   gradient   -l s' c g, g that of the angle (axis_row.hpp)
//   quad       -l (s' c quad_q + s'' (c qdot)^2),  qdot = z_a.(w_b - w_a)
//   curvature  -l (s' c dg + s'' c^2 g g^T)
#include <cassert>

#include "floatframe/model/axis_row.hpp"
#include "floatframe/model/cam_profile.hpp"

namespace floatframe {

template <>
void constraint_rows_of<ConstraintType::cam_angle>(const ConstraintPart& part, const MarkerState& a,
                                                   const MarkerState& b, double,
                                                   ConstraintRow* rows) noexcept {
  assert(part.lift);
  const double angle = angle_about_z<double>(a, b, part.angle ? *part.angle : 0.0);
  const PiecewisePolynomial::Value s = (*part.lift)(part.c * angle);
  fill_angle_row(-part.scale * s.df * part.c, a, b, *rows);
  const double rate = part.c * a.R.col(2).dot(b.w - a.w);
  rows->phi = -part.scale * s.f;
  rows->quad -= part.scale * s.ddf * rate * rate;
}

template <>
void constraint_curvature_of<ConstraintType::cam_angle>(const ConstraintPart& part,
                                                        const MarkerState& a, const MarkerState& b,
                                                        const double* lambda, Mat12& K) noexcept {
  using namespace part_of;
  const double angle = angle_about_z<double>(a, b, part.angle ? *part.angle : 0.0);
  const PiecewisePolynomial::Value s = (*part.lift)(part.c * angle);
  add_angle_curvature(-lambda[0] * part.scale * s.df * part.c, a, K);
  const Vec3 z = a.R.col(2);
  const Mat3 Z = (-lambda[0] * part.scale * s.ddf * part.c * part.c) * z * z.transpose();
  K.block<3, 3>(pi_a, pi_a) += Z;
  K.block<3, 3>(pi_b, pi_b) += Z;
  K.block<3, 3>(pi_a, pi_b) -= Z;
  K.block<3, 3>(pi_b, pi_a) -= Z;
}

constinit const ConstraintKind cam_angle_constraint = {
    .points = false, .on_axis = true, .holds = "lift of a cam"};

}  // namespace floatframe
