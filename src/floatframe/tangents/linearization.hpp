#pragma once
// The equations of motion about a state. With r(q, v, a, lambda) the residual without penalty,
//   r = M a - Q(q, v, t) + Phi_q^T lambda,
// small changes x of the configuration, their rates and accelerations, and dlambda of the
// multipliers give
//   r + M xddot + C xdot + K x + J^T dlambda,   Phi + J x,                                     (1)
//   M = dr/da,  C = dr/dv,  K = dr/dx,  J = Phi_q.
// r is linear in a: a column of M is a difference of two residuals, exact up to round-off, which is
// smallest if M times the trial acceleration is at least as large as the forces. C and K are
// exact in the efforts of elements (element_tangents.hpp), else central differences (K contains the
// geometric stiffness of forces and multipliers), here at a = 0, as needed for statics;
// small_motions.hpp computes them at given accelerations. Dense, allocates: load time only.
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
VecX equilibration(const MatX& A);

/// r without accelerations at t, q, v: moves `f` there, up to `dynamics`.
VecX residual_at(Formulation& f, double t, const VecX& q, const VecX& v, const VecX& lambda);

/// The largest of the weight and of the forces and torques of elements at the last evaluation [N],
/// [N m]: imbalances are measured against it.
double largest_load(const Formulation& f);

/// M d at the state of `f`, from r0, the residual there without accelerations, at size d.
VecX mass_times(Formulation& f, const VecX& d, double size, const VecX& r0, const VecX& lambda);

/// M at the state of `f`, its columns from trial accelerations of these sizes.
MatX mass_matrix(Formulation& f, const VecX& sizes, const VecX& r0, const VecX& lambda);

/// K at t, q, v: moves `f`.
MatX stiffness_matrix(Formulation& f, const State& s);

}  // namespace floatframe
