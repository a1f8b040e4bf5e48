#pragma once
// Requirements of the integrator on a formulation: the equations of motion of a constrained system
//   M(q) a + Phi_q^T (alpha Phi + lambda) = Q(q, v, t),   Phi(q, t) = 0,            (1)
// in nq configuration numbers q, nv velocities v and accelerations a, nc multipliers lambda.
// Increments x of the configuration have nv numbers, q = q0 (+) x (`retract`): rotation vectors for
// quaternions.
//
// Order of calls. A formulation keeps one evaluation of the system; each call requires results of
// earlier calls and provides results for later ones.
//
//   call                        needs           leaves
//   stepping(true)                              the beginning of a step: saves data to be restored
//                                               if the step is not accepted
//   positions(t, q)                             markers, directions of motion
//   velocities(v)               positions       velocities, bias accelerations; Phi and Phi_q at
//                                               these positions
//   dynamics()                  velocities      M, inertia and applied forces
//   forces()                    velocities      applied forces alone
//   residual(a, lambda, alpha,  dynamics        out; lambda for the tangent's geometric stiffness
//            out)
//   factorize(.., slot)         residual        T with its directions of motion, in the slot
//   factorize_metric(.., slot)  velocities      W with its directions of motion, in the slot; M is
//                                               that of the last dynamics
//   solve(.., slot)             a matrix in     b; the configuration may have moved since
//                               the slot
//   constraint_rates(out)       velocities      out = Phidot = Phi_q v + Phi_t
//   constraint_accelerations    velocities      out = Phiddot = Phi_q a + (Phi_q)dot v + Phi_tt;
//           (a, out)                            the accelerations that outputs look at
//   constraint_increments       velocities      out = Phi_q delta
//           (delta, out)
//   constraint_forces(w, out)   velocities      out = Phi_q^T w
//   balance(lambda, r)          residual        multipliers internal to the formulation
//   loads(out)                  -               the loads of joints that elements read
//   find_loads(a, lambda, out)  dynamics        those of the reactions of a and lambda
//   set_loads(loads)            dynamics        the efforts of these elements with these loads
//   retract(q0, x, q)                           q = q0 (+) x
//   settle(q0, x)                               x such that q0 (+) x satisfies exact constraints
//                                               of the formulation
//   advance(x, delta)           positions       x such that q0 (+) x = (q0 (+) x_old) (+) delta,
//                               at q0 (+) x
//   element_states()            -               states of elements: given, or following in each
//                                               evaluation of forces
//   solve_element_states()      velocities      those that follow, alone
//   change_kept_states()        velocities      numbers of elements that change between steps
//   stepping(false, accepted)                   the end of the step
//
// Asserts follow this order (call_order.hpp).
// positions, velocities, dynamics, residual and the constraint_* functions may be repeated in any
// order that satisfies these requirements; the results of an evaluation do not depend on earlier
// ones except for the turns counted by angles of springs (`stepping`).
//
// All of it runs in steps: noexcept, free of allocation and exceptions. The classes are final, so
// that a step calls no virtual function.
#include <concepts>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// In `own_frequencies_squared`: a massless coordinate of a body, or amplitude of a mode.
inline constexpr double no_inertia = -1.0;

// clang-format off
template <class F>
concept EquationsOfMotion = requires(F& f, const F& c, double x, int slot, const VecX& in,
                                     VecX& out, MatX& matrix) {
  // Sizes nv, nq, nc.
  { c.velocities() } noexcept -> std::same_as<int>;
  { c.configurations() } noexcept -> std::same_as<int>;
  { c.constraints() } noexcept -> std::same_as<int>;
  /// The saving in iterations above which a new factorisation pays off.
  requires std::same_as<decltype(F::factorization_cost), const double>;

  { f.stepping(true) } noexcept -> std::same_as<void>;
  { f.stepping(false, true) } noexcept -> std::same_as<void>;

  // One evaluation of the system: (t, q), (v), then the terms.
  { f.positions(x, in) } noexcept -> std::same_as<void>;
  { f.velocities(in) } noexcept -> std::same_as<void>;
  { f.dynamics() } noexcept -> std::same_as<void>;
  { f.forces() } noexcept -> std::same_as<void>;
  /// out = M a - Q + Phi_q^T (alpha Phi + lambda), for (a, lambda, alpha, out)
  { f.residual(in, in, x, out) } noexcept -> std::same_as<void>;

  /// T = M mass + damping C + s (K + alpha Phi_q^T Phi_q), for (mass, damping, s, alpha, slot),
  /// with the forces and multipliers of the last `residual`. -1, or a coordinate with a vanishing
  /// pivot.
  { f.factorize(x, x, x, x, slot) } noexcept -> std::same_as<int>;
  /// W = M + s K + penalty Phi_q^T Phi_q, for (s, penalty, slot): modal stiffness and that of
  /// forces, without geometric stiffness: the metric of the projections. -1, or a coordinate with a
  /// vanishing pivot.
  { f.factorize_metric(x, x, slot) } noexcept -> std::same_as<int>;
  /// Sum of the logarithms of the pivots of a slot's factorisation: log |det| up to constant terms
  /// of a formulation.
  { c.log_pivots(slot) } noexcept -> std::same_as<double>;
  /// b := T^-1 b
  { f.solve(out, slot) } noexcept -> std::same_as<void>;
  /// b := T^-1 (b - penalty Phi_q^T phi) and mu := phi + Phi_q b, for (b, phi, penalty, mu, slot),
  /// with the Phi_q and the penalty of the factorisation: penalty mu are the multipliers of
  ///   T0 x + Phi_q^T (penalty mu) = b,  Phi_q x - mu = -phi,  T0 = T without its penalty.    (2)
  /// Constraints that a formulation satisfies exactly have mu = 0. A slot keeps one factorisation
  /// with its directions of motion.
  { f.solve(out, in, x, out, slot) } noexcept -> std::same_as<void>;
  /// Adds to lambda, and to the residual r, the multipliers of constraints that the formulation
  /// satisfies exactly, for (lambda, r), after `residual`.
  { f.balance(out, out) } noexcept -> std::same_as<void>;

  /// Of the joints whose reactions elements read (model/joint_load.hpp), for (loads),
  /// (a, lambda, loads), (loads). They stay those of the last `set_loads`, and are a part of the
  /// states of elements. The tangent leaves out that they depend on a and lambda.
  { c.load_count() } noexcept -> std::same_as<int>;
  { c.loads(out) } noexcept -> std::same_as<void>;
  { f.find_loads(in, in, out) } noexcept -> std::same_as<void>;
  { f.set_loads(in) } noexcept -> std::same_as<void>;

  /// Signals between elements add B V^T to T, for (damping, s, B, V), nv x the rank.
  { c.signal_rank() } noexcept -> std::same_as<int>;
  { f.signal_tangent(x, x, matrix, matrix) } noexcept -> std::same_as<void>;

  // Constraints at the present positions and velocities.
  { c.constraint_values() } noexcept -> std::same_as<const VecX&>;
  { f.constraint_rates(out) } noexcept -> std::same_as<void>;
  { f.constraint_accelerations(in, out) } noexcept -> std::same_as<void>;
  { f.constraint_increments(in, out) } noexcept -> std::same_as<void>;
  { f.constraint_forces(in, out) } noexcept -> std::same_as<void>;

  /// K_kk / M_kk of modal amplitudes, zero for rigid coordinates, or `no_inertia` [1/s2]: for the
  /// predictor of a step.
  { c.own_frequencies_squared() } noexcept -> std::same_as<const VecX&>;

  { f.element_states().follow(x, in) } noexcept -> std::same_as<void>;
  { f.solve_element_states() } noexcept -> std::same_as<void>;
  { f.change_kept_states() } noexcept -> std::same_as<void>;

  // Configurations: (q0, x, q), (q0, x) and (x, delta).
  { c.retract(in, in, out) } noexcept -> std::same_as<void>;
  { c.settle(in, out) } noexcept -> std::same_as<void>;
  { c.advance(out, in) } noexcept -> std::same_as<void>;
};
// clang-format on

}  // namespace floatframe
