#pragma once
// The state a run starts from, found once at load time in relative coordinates (dense linear
// algebra, allocates, throws):
//   close_loops       least change of the start values that satisfies the position and velocity
//   constraints;
//                     coordinates the user gave a value for move last
//   find_equilibrium  static equilibrium: Newton with pseudo-transient regularisation on the full
//   residual start_accelerations  a and lambda from M a + Phi_q^T lambda = Q, Phi_q a = gamma, in
//   any formulation
#include <Eigen/Dense>
#include <functional>
#include <string>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

/// At time t. Throws RunError naming the joint or rod that stays open.
void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool positions, double t = 0.0);

struct Equilibrium {
  int iterations = 0;
  double residual = 0.0;
  VecX lambda;
};
/// Throws RunError naming the coordinate with the largest unbalanced force.
Equilibrium find_equilibrium(RelativeFormulation& f, VecX& q);

/// Start of a run in relative coordinates: the model's start values with loops closed, or the
/// equilibrium with the model's start velocities. `start_state` knows states and offsets, too.
State relative_start(RelativeFormulation& f, Start start);

/// s alpha of the integrator when the user gives no penalty: 1e5 mean body masses.
double default_penalty_mass(const Model& model);

/// The integrator's options that a simulation description asks for.
StepOptions step_options(const Model& model, const SimulationDescription& o);

/// Dense fallback for mass matrices that are singular on the null space of the constraints only
/// where stiffness acts. `mass`, `stiffness`: nv x nv, `J`: nc x nv. Throws RunError naming the
/// coordinate that has neither.
void dense_start(const MatX& mass, const MatX& stiffness, const MatX& J, const VecX& force,
                 const VecX& gamma, const std::function<std::string(int)>& owner, VecX& a,
                 VecX& lambda);

/// True if the mass matrix has a diagonal entry of round-off size (systems beyond 1000 coordinates
/// are not searched).
template <class F>
bool has_massless_coordinate(F& f, const State& state) {
  const int nv = f.velocities();
  if (nv == 0 || nv > 1000) return false;
  const VecX zero = VecX::Zero(nv);
  VecX r0(nv), column(nv), diagonal(nv);
  f.residual(zero, state.lambda, 0.0, r0);
  for (int j = 0; j < nv; ++j) {
    f.residual(VecX::Unit(nv, j), state.lambda, 0.0, column);
    diagonal[j] = column[j] - r0[j];
  }
  return diagonal.minCoeff() < 1e-9 * diagonal.maxCoeff();
}

/// Fills state.a, state.a_alg and state.lambda at state.q, state.v, state.t.
template <class F>
void start_accelerations(F& f, State& state, double penalty_mass) {
  const int nv = f.velocities(), nc = f.constraints();
  state.a = VecX::Zero(nv);
  state.lambda = VecX::Zero(nc);
  f.positions(state.t, state.q);
  f.velocities(state.v);
  f.dynamics();
  double s = 1e-30;  // no stiffness in the tangent: M + penalty Phi_q^T Phi_q
  VecX r(nv), gamma(nc), push(nv);
  // A freedom whose mass is round-off passes the pivot test by luck: look at the diagonal of M
  // first.
  bool good = !has_massless_coordinate(f, state) && f.factorize(1.0, 0.0, s, penalty_mass / s) < 0;
  bool settled = good;
  if (!good && nv > 1000) {
    // The dense computation below would take minutes. A little stiffness holds what has no mass;
    // that is the solution too if no force acts there, and otherwise the passes do not settle.
    s = 1e-10;
    good = f.factorize(1.0, 0.0, s, penalty_mass / s) < 0;
    settled = false;
  }
  if (good) {
    double worst = 0.0;
    for (int pass = 0; pass < 60; ++pass) {
      f.residual(state.a, state.lambda, 0.0, r);
      f.constraint_accelerations(state.a, gamma);
      VecX w = penalty_mass * gamma;
      f.constraint_forces(w, push);
      VecX delta = -(r + push);
      f.solve(delta);
      state.a += delta;
      f.constraint_accelerations(state.a, gamma);
      state.lambda += penalty_mass * gamma;
      worst = nc > 0 ? gamma.lpNorm<Eigen::Infinity>() : 0.0;
      if (!delta.allFinite()) break;
      const double size = 1.0 + state.a.lpNorm<Eigen::Infinity>();
      if (pass > 0 && worst < 1e-9 * size && delta.lpNorm<Eigen::Infinity>() < 1e-9 * size) {
        settled = true;
        break;
      }
    }
    const double size = 1.0 + state.a.lpNorm<Eigen::Infinity>();
    good = settled && state.a.allFinite() && worst < 1e-5 * size && size < 1e7;
  }
  if (!good) {
    MatX mass(nv, nv), stiffness(nv, nv);
    const VecX zero = VecX::Zero(nv), no_lambda = VecX::Zero(nc);
    VecX r0(nv), column(nv), q1(state.q.size()), x = VecX::Zero(nv);
    f.residual(zero, no_lambda, 0.0, r0);
    for (int j = 0; j < nv; ++j) {
      f.residual(VecX::Unit(nv, j), no_lambda, 0.0, column);
      mass.col(j) = column - r0;
    }
    const MatX J = f.constraint_jacobian();
    f.constraint_accelerations(zero, gamma);
    for (int j = 0; j < nv; ++j) {
      constexpr double step = 1e-7;
      x.setZero();
      x[j] = step;
      f.retract(state.q, x, q1);
      f.positions(state.t, q1);
      f.velocities(state.v);
      f.dynamics();
      f.residual(zero, no_lambda, 0.0, column);
      stiffness.col(j) = (column - r0) / step;
    }
    dense_start(
        mass, stiffness, J, -r0, -gamma, [&](int i) { return f.coordinate_owner(i); }, state.a,
        state.lambda);
  }
  state.a_alg = state.a;
  f.positions(state.t, state.q);
  f.velocities(state.v);
  f.dynamics();
}

}  // namespace floatframe
