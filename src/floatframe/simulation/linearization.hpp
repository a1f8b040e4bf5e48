#pragma once
// The equations of motion about a state. With r(q, v, a, lambda) the residual without penalty,
//   r = M a - Q(q, v, t) + Phi_q^T lambda,
// small changes x of the configuration, their rates and accelerations, and dlambda of the
// multipliers give
//   r + M xddot + C xdot + K x + J^T dlambda,   Phi + J x,                                     (1)
//   M = dr/da,  C = dr/dv,  K = dr/dx,  J = Phi_q.
// r is linear in a: a column of M is a difference of two residuals, exact up to round-off, which is
// smallest if M times the trial acceleration is at least as large as the forces. C and K are
// central differences (K contains the geometric stiffness of forces and multipliers), here at a =
// 0, as needed for statics; small_motions.hpp computes them at given accelerations. Dense,
// allocates: load time only.
#include <cmath>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// The n columns (g(step e_j) - g(-step e_j)) / (2 step) of a function of an increment.
template <class G>
MatX central_differences(Eigen::Index n, double step, const G& g) {
  VecX x = VecX::Zero(n);
  if (n == 0) return MatX(g(x).size(), 0);
  MatX columns;
  for (Eigen::Index j = 0; j < n; ++j) {
    x[j] = step;
    const VecX ahead = g(x);
    x[j] = -step;
    const VecX behind = g(x);
    x[j] = 0.0;
    if (j == 0) columns.resize(ahead.size(), n);
    columns.col(j) = (ahead - behind) / (2.0 * step);
  }
  return columns;
}

/// Scale factors of rows and columns of a symmetric system whose forces and lengths differ by many
/// orders of magnitude: the entries become of order one.
inline VecX equilibration(const MatX& A) {
  VecX scale(A.rows());
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const double size = A.row(i).cwiseAbs().maxCoeff();
    scale[i] = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  }
  return scale;
}

/// r without accelerations at t, q, v: moves `f` there, up to `dynamics`.
inline VecX residual_at(Formulation& f, double t, const VecX& q, const VecX& v,
                        const VecX& lambda) {
  VecX r(f.velocities());
  kinematics_at(f, t, q, v);
  f.dynamics();
  f.residual(VecX::Zero(f.velocities()), lambda, 0.0, r);
  return r;
}

/// M d at the state of `f`, from r0, the residual there without accelerations, at size d.
inline VecX mass_times(Formulation& f, const VecX& d, double size, const VecX& r0,
                       const VecX& lambda) {
  VecX r(f.velocities());
  f.residual(size * d, lambda, 0.0, r);
  return (r - r0) / size;
}

/// M at the state of `f`, its columns from trial accelerations of these sizes.
inline MatX mass_matrix(Formulation& f, const VecX& sizes, const VecX& r0, const VecX& lambda) {
  const int nv = f.velocities();
  MatX M(nv, nv);
  for (int j = 0; j < nv; ++j) M.col(j) = mass_times(f, VecX::Unit(nv, j), sizes[j], r0, lambda);
  return M;
}

/// K at t, q, v: moves `f`.
inline MatX stiffness_matrix(Formulation& f, const State& s) {
  constexpr double step = 1e-6;  // [m, rad, amplitudes]
  VecX q = s.q;
  return central_differences(f.velocities(), step, [&](const VecX& x) {
    f.retract(s.q, x, q);
    return residual_at(f, s.t, q, s.v, s.lambda);
  });
}

/// C at t, q, v: moves `f`. Inertia and laws of dampers are at most of second order in v: the step
/// may be large.
inline MatX damping_matrix(Formulation& f, const State& s) {
  constexpr double step = 1e-3;  // [m/s, rad/s, amplitudes/s]
  return central_differences(f.velocities(), step, [&](const VecX& x) {
    return residual_at(f, s.t, s.q, VecX(s.v + x), s.lambda);
  });
}

}  // namespace floatframe
