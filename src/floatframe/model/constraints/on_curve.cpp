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
//
// If a slides along nodes of its body (slide_path.hpp), its point is c(u) and the curve deforms
// with the modes. e and pdot are then those from c, as the material point moves, and with the rates
// c*' and n_i* of the tangent and of the normals at this u (CurveFoot) there are besides
//   quad       -2 n_i.c*' udot + 2 n_i*.(pdot - c' udot)                                     (1)
// and terms of e: exact where the point is on the curve. The first is the Coriolis force of a load
// that moves along a line whose slope changes; its centripetal force is in H_i.
#include "floatframe/model/curve_row.hpp"

namespace floatframe {

namespace {

Mat3 on_curve_hessian(const CurveFoot& f, int i) noexcept {
  const Vec3 across = f.n_u[i] - f.t * f.t.dot(f.n_u[i]);
  return f.n_u[i] * f.u_p.transpose() + f.u_p * across.transpose();
}

Vec3 on_curve_gradient(const CurveFoot& f, int i) noexcept {
  return f.n[i] + f.n_u[i].dot(f.e) * f.u_p;
}

}  // namespace

template <>
void constraint_rows_of<ConstraintType::on_curve>(const ConstraintPart& part, const MarkerState& a,
                                                  const MarkerState& b, double,
                                                  ConstraintRow* rows) noexcept {
  const CurveFoot f = foot_of_curve(part.curve, a, b);
  const Vec3 p_dot = rate_against_curve(a, b);
  const double u_dot = f.rate(p_dot);
  for (int i = 0; i < 2; ++i) {
    fill_axis_row(a.R * on_curve_gradient(f, i), a, b, rows[i]);
    rows[i].phi = f.n[i].dot(f.e);
    rows[i].quad += p_dot.dot(on_curve_hessian(f, i) * p_dot);
    if (a.foot)
      rows[i].quad += 2.0 * (f.n_rate[i].dot(p_dot - u_dot * f.dc) - u_dot * f.n[i].dot(f.dc_rate));
  }
}

template <>
void constraint_curvature_of<ConstraintType::on_curve>(const ConstraintPart& part,
                                                       const MarkerState& a, const MarkerState& b,
                                                       const double* lambda, Mat12& K) noexcept {
  const CurveFoot f = foot_of_curve(part.curve, a, b);
  for (int i = 0; i < 2; ++i)
    add_curve_curvature(lambda[i], on_curve_gradient(f, i), on_curve_hessian(f, i), a, b, K);
}

constinit const ConstraintKind on_curve_constraint = {.rows = 2};

}  // namespace floatframe
