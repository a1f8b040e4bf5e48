#pragma once
// Accelerations a and multipliers lambda that satisfy the equations of motion at a state (q, v):
//   M a + Phi_q^T lambda = Q,   Phi_q a = gamma                                              (1)
// with gamma = -((Phi_q)dot v + Phi_tt), and the wrenches that joints, rods and motors transmit
// with them. A step knows neither: its accelerations are those of the integrator before and after
// their projection, and the projections exchange impulses.
//
// With the penalty p and W = M + p Phi_q^T Phi_q, from lambda = 0 on, until round-off is left:
//   W da = -(M a + Phi_q^T lambda - Q) - p Phi_q^T (Phi_q a - gamma)
//   a += da,   lambda += p (Phi_q a - gamma)                                                 (2)
// The errors shrink with each pass by 1 / (1 + p e), e the eigenvalues of Phi_q M^-1 Phi_q^T. All
// of lambda comes from Phi_q times something: where (1) leaves it open it is that of least norm, of
// the formulation's own multipliers. Where the start shows redundant constraints, the passes begin
// with the multipliers of the step, and `LeastReactions` makes of their wrenches those of least
// norm of the multipliers of all joints, which are the same in both formulations. A freedom without
// mass makes W singular; then W = M + h^2 K + p Phi_q^T Phi_q with the step h: accelerations along
// such a freedom mean nothing, and no reaction depends on them.
//
// Wrenches. In absolute coordinates all joints have multipliers; in relative coordinates those of
// the tree are what balances each body, from the leaves to the root
// (`RelativeFormulation::tree_joint_wrench`). Either way the balance of every body - inertia,
// applied forces, reactions, modal forces - is (1).
//
// It has a formulation of its own, so that a step does not depend on whether its reactions are
// looked at, and remembers nothing of earlier states. Built only if a model asks for such outputs;
// `solve` allocates nothing.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/integrator/step.hpp"
#include "floatframe/model/output_view.hpp"
#include "floatframe/simulation/least_reactions.hpp"

namespace floatframe {

struct ReactionOptions {
  double penalty_mass = 1.0;  ///< p [kg]
  double step = 1e-3;         ///< h [s]
  bool redundant = false;     ///< constraints are, at the start
};

template <class F>
class ReactionSolver {
 public:
  /// `start`: a state at which masses and redundant constraints are judged. Allocates; throws as F.
  ReactionSolver(const Model& model, InertiaMethod method, const State& start,
                 const ReactionOptions& options);
  ReactionSolver(const ReactionSolver&) = delete;
  ReactionSolver& operator=(const ReactionSolver&) = delete;

  /// At t, q, v of the state, with the inputs, angles of springs and branches of forces (those that
  /// are held) of the formulation that made it; `a` of the state is where the iteration begins.
  void solve(const State& state, std::span<const double> inputs,
             std::span<const double> spring_angles,
             std::span<const std::int64_t> force_branches = {}) noexcept;

  /// Impulses of the constraints of `set`, which is at the state of the last `solve`.
  void set_impulses(const ConstraintSet& set, const VecX& impulses) noexcept;

  const VecX& accelerations() const noexcept { return a_; }
  const VecX& multipliers() const noexcept { return lambda_; }
  const Reactions& reactions() const noexcept { return reactions_; }
  /// What is left of (1), the largest generalised force.
  double force_error() const noexcept { return force_error_; }
  /// A freedom has no mass at the start.
  bool lacks_mass() const noexcept { return lacks_mass_; }
  /// At the last state, with its accelerations.
  F& formulation() noexcept { return f_; }

  /// The outputs of the model, by name, that redundant constraints leave open at the start.
  const std::vector<std::string>& open_outputs() const noexcept { return open_; }

 private:
  int factorize() noexcept;
  void iterate(bool refines) noexcept;
  void find_force_error() noexcept;
  void collect_wrenches() noexcept;
  void find_open_outputs(const State& start);

  F f_;
  ReactionOptions options_;
  bool lacks_mass_ = false;
  bool has_W_ = false;  ///< factorised
  std::optional<LeastReactions<F>> least_;
  VecX a_, lambda_, residual_, gamma_, delta_, work_, best_a_, best_lambda_;
  double force_error_ = 0.0;
  Reactions reactions_;
  std::vector<std::string> open_;
};

extern template class ReactionSolver<RelativeFormulation>;
extern template class ReactionSolver<AbsoluteFormulation>;

}  // namespace floatframe
