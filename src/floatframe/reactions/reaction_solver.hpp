#pragma once
// Accelerations a and multipliers lambda that satisfy the equations of motion at a state (q, v):
//   M a + Phi_q^T lambda = Q,   Phi_q a = gamma                                              (1)
// with gamma = -((Phi_q)dot v + Phi_tt), and the resulting wrenches of joints, rods and motors.
// Neither is available in a step: its accelerations are those of the integrator before and after
// their projection, and the projections exchange impulses.
//
// With the penalty p and W = M + p Phi_q^T Phi_q, starting at lambda = 0, until round-off remains:
//   W da = -(M a + Phi_q^T lambda - Q) - p Phi_q^T (Phi_q a - gamma)
//   a += da,   lambda += p (Phi_q a - gamma)                                                 (2)
// Each pass reduces the errors by 1 / (1 + p e), e the eigenvalues of Phi_q M^-1 Phi_q^T. All of
// lambda is a product with Phi_q: where (1) does not determine it, it is that of least norm in the
// multipliers of the formulation. If constraints are redundant at the start, the passes begin with
// the multipliers of the step, and `LeastReactions` converts their wrenches to those of least norm
// in the multipliers of all joints, which are the same in both formulations. A massless coordinate
// makes W singular; then W = M + h^2 K + p Phi_q^T Phi_q with the step h: accelerations along such
// a coordinate are undefined, and no reaction depends on them.
//
// Wrenches. In absolute coordinates all joints have multipliers; in relative coordinates those of
// the tree follow from the balance of each body, from the leaves to the root
// (`Formulation::add_tree_wrenches`). In both cases the balance of every body - inertia,
// applied forces, reactions, modal forces - is (1).
//
// It uses a separate formulation, so that steps do not depend on whether reactions are evaluated,
// and keeps no data of earlier states. Constructed only if a model has such outputs; `solve` does
// not allocate.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/integrator/step.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/reactions/least_reactions.hpp"

namespace floatframe {

struct ReactionOptions {
  double penalty_mass = 1.0;  ///< p [kg]
  double step = 1e-3;         ///< h [s]
  bool redundant = false;     ///< true if constraints are redundant at the start
};

class ReactionSolver {
 public:
  /// `start`: the state at which masses and redundancy are checked. Allocates; throws as
  /// `make_formulation`.
  ReactionSolver(Coordinates coordinates, const Model& model, InertiaMethod method,
                 const State& start, const ReactionOptions& options);
  ReactionSolver(const ReactionSolver&) = delete;
  ReactionSolver& operator=(const ReactionSolver&) = delete;

  /// At t, q, v of the state, with the inputs, angles of springs and held branches of forces of the
  /// formulation that produced the state; the iteration starts from the `a` of the state.
  void solve(const State& state, std::span<const double> inputs,
             std::span<const double> spring_angles,
             std::span<const std::int64_t> force_branches = {}) noexcept;

  /// Impulses of the constraints of `set`, which is at the state of the last `solve`.
  void set_impulses(const ConstraintSet& set, const VecX& impulses) noexcept;

  const VecX& accelerations() const noexcept { return a_; }
  const VecX& multipliers() const noexcept { return lambda_; }
  const Reactions& reactions() const noexcept { return reactions_; }
  /// The residual of (1), as the largest generalised force.
  double force_error() const noexcept { return force_error_; }
  /// True if some coordinate is massless at the start.
  bool lacks_mass() const noexcept { return lacks_mass_; }
  /// At the last state, with its accelerations.
  Formulation& formulation() noexcept { return f_; }

  /// The names of outputs that are not unique at the start because of redundant constraints.
  const std::vector<std::string>& open_outputs() const noexcept { return open_; }

 private:
  int factorize() noexcept;
  void iterate(bool refines) noexcept;
  void find_force_error() noexcept;
  void collect_wrenches() noexcept;
  void find_open_outputs(const State& start);

  std::unique_ptr<Formulation> own_;
  Formulation& f_;  ///< *own_
  ReactionOptions options_;
  bool lacks_mass_ = false;
  bool has_W_ = false;  ///< factorised
  std::optional<LeastReactions> least_;
  VecX a_, lambda_, residual_, gamma_, delta_, work_, best_a_, best_lambda_;
  double force_error_ = 0.0;
  Reactions reactions_;
  std::vector<std::string> open_;
};

}  // namespace floatframe
