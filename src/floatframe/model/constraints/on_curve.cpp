// On a curve: the point of b stays on a curve fixed in a (space_curve.hpp). With p = R_a^T (r_b -
// r_a), its foot point, e = p - c and the normals n_i there:
//   phi_i      n_i.e = 0, i = 1, 2                                              2 rows
//   gradient   that along an axis R_a m_i that rotates with a (axis_row.hpp), m_i = dphi_i/dp
//              m_i = n_i + (n_i'.e) u_p
//   quad       of that axis, and pdot.H_i pdot, H_i = dm_i/dp
//              H_i = n_i' u_p^T + u_p (n_i' - t t.n_i')^T, symmetric
//   curvature  of that axis, and P^T H_i P, dp = P d(motion)
// H_i is exact for plane curves, and for others where the point is on the curve: it leaves out
// terms of e. So the parameter u is eliminated, and is no state: where a curve comes close to
// itself the nearer branch holds.
#include <cassert>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/axis_row.hpp"
#include "floatframe/model/space_curve.hpp"

namespace floatframe {

namespace {

Mat3 on_curve_hessian(const SpaceCurve::Foot& f, int i) noexcept {
  const Vec3 across = f.n_u[i] - f.t * f.t.dot(f.n_u[i]);
  return f.n_u[i] * f.u_p.transpose() + f.u_p * across.transpose();
}

Vec3 on_curve_gradient(const SpaceCurve::Foot& f, int i) noexcept {
  return f.n[i] + f.n_u[i].dot(f.e) * f.u_p;
}

}  // namespace

template <>
void constraint_rows_of<ConstraintType::on_curve>(const ConstraintPart& part, const MarkerState& a,
                                                  const MarkerState& b, double,
                                                  ConstraintRow* rows) noexcept {
  assert(part.curve);
  const Vec3 d = b.r - a.r;
  const SpaceCurve::Foot f = part.curve->foot(a.R.transpose() * d);
  const Vec3 p_dot = a.R.transpose() * (b.v - a.v - a.w.cross(d));
  for (int i = 0; i < 2; ++i) {
    fill_axis_row(a.R * on_curve_gradient(f, i), a, b, rows[i]);
    rows[i].phi = f.n[i].dot(f.e);
    rows[i].quad += p_dot.dot(on_curve_hessian(f, i) * p_dot);
  }
}

template <>
void constraint_curvature_of<ConstraintType::on_curve>(const ConstraintPart& part,
                                                       const MarkerState& a, const MarkerState& b,
                                                       const double* lambda, Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 d = b.r - a.r;
  const SpaceCurve::Foot f = part.curve->foot(a.R.transpose() * d);
  Eigen::Matrix<double, 3, 12> P = Eigen::Matrix<double, 3, 12>::Zero();
  P.middleCols<3>(r_a) = -a.R.transpose();
  P.middleCols<3>(pi_a) = a.R.transpose() * skew(d);
  P.middleCols<3>(r_b) = a.R.transpose();
  for (int i = 0; i < 2; ++i) {
    add_axis_curvature(a.R * on_curve_gradient(f, i), a, b, lambda[i], K);
    K += lambda[i] * P.transpose() * on_curve_hessian(f, i) * P;
  }
}

constinit const ConstraintKind on_curve_constraint = {.rows = 2};

}  // namespace floatframe
