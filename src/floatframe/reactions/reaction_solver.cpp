#include "floatframe/reactions/reaction_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/reactions/part_wrenches.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {

namespace {

constexpr int reaction_slot = 0;
/// Largest number of passes of (2); ends earlier if the last ones have not improved.
constexpr int most_passes = 60, idle_passes = 3;
/// Relative changes below which accelerations and multipliers count as converged.
constexpr double enough = 1e-11;
/// Penalty factor: saves passes where redundant constraints increase the cost per row.
constexpr double stiffer = 30.0;
/// A pass that leaves more than this fraction of the multipliers' errors does not reduce them.
constexpr double slow = 0.5;
/// Relative variation due to redundant constraints above which an output is not unique.
constexpr double left_open = 1e-6;

double largest_entry(const VecX& x) noexcept {
  double m = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) m = std::max(m, std::abs(x[i]));
  return m;
}

}  // namespace

ReactionSolver::ReactionSolver(Coordinates coordinates, const Model& model, InertiaMethod method,
                               const State& start, const ReactionOptions& options)
    : own_(make_formulation(coordinates, model, method)), f_(*own_), options_(options) {
  const int nv = f_.velocities(), nc = f_.constraints();
  assert(options.penalty_mass > 0.0 && options.step > 0.0);
  a_ = residual_ = delta_ = best_a_ = VecX::Zero(nv);
  lambda_ = gamma_ = work_ = best_lambda_ = VecX::Zero(nc);
  reactions_.joints.resize(model.joints.size());
  reactions_.elements.resize(model.elements.size());
  reactions_.forces.assign(model.elements.size(), 0.0);
  reactions_.joint_impulses.assign(model.joints.size(), Vec3::Zero());
  reactions_.element_impulses.assign(model.elements.size(), Vec3::Zero());
  if (options.redundant) {
    // The penalty of absolute coordinates is already as large as digits allow.
    if (coordinates == Coordinates::relative) options_.penalty_mass *= stiffer;
    least_.emplace(model);
  }
  const VecX possible = possible_masses(f_, start);
  dynamics_at(f_, start);
  lacks_mass_ = may_lack_mass(f_, mass_diagonal(f_, start), possible, options.penalty_mass);
  if (least_) find_open_outputs(start);
}

int ReactionSolver::factorize() noexcept {
  constexpr double s = 1e-30;  // no stiffness
  has_W_ = !lacks_mass_ && f_.factorize(1.0, 0.0, s, options_.penalty_mass / s, reaction_slot) < 0;
  if (has_W_) return -1;
  return f_.factorize_metric(options_.step * options_.step, options_.penalty_mass, reaction_slot);
}

void ReactionSolver::solve(const State& state, std::span<const double> inputs,
                           std::span<const double> spring_angles,
                           std::span<const std::int64_t> force_branches) noexcept {
  assert(state.v.size() == f_.velocities() && state.lambda.size() == f_.constraints());
  assert(state.a.size() == f_.velocities() && all_finite(state.a));
  FLOATFRAME_DEBUG(for (Vec3& x : reactions_.joint_impulses) poison(x);)
  FLOATFRAME_DEBUG(for (Vec3& x : reactions_.element_impulses) poison(x);)
  if (!force_branches.empty()) f_.hold_force_branches(force_branches);
  f_.set_inputs(inputs);
  f_.set_spring_angles(spring_angles);
  dynamics_at(f_, state);
  a_ = state.a;
  // With redundant constraints any solution will do: those of the step are close.
  if (least_)
    lambda_ = state.lambda;
  else
    lambda_.setZero();
  f_.residual(a_, lambda_, 0.0, residual_);  // multipliers of the tangent
  const bool factorised = factorize() < 0;
  // Without multipliers only the forces are refined.
  const bool shortened = factorised && has_W_ && f_.constraints() > 0;
  if (factorised) iterate(!shortened);
  find_force_error();
  // Round-off of W^-1.
  if (shortened && force_error_ > enough * largest_entry(lambda_)) {
    iterate(true);
    find_force_error();
  }
  collect_wrenches();
  if (!least_) return;
  least_->place(f_);
  least_->project_to_minimum_norm(f_, reactions_);
}

void ReactionSolver::find_force_error() noexcept {
  f_.residual(a_, lambda_, 0.0, residual_);
  f_.balance(lambda_, residual_);
  force_error_ = largest_entry(residual_);
}

/// (2), with the residual already computed. With W itself a pass leaves no forces in (1), and Phi_q
/// a - gamma is known from the solution; `refines`: both are computed again. The best of the passes
/// is kept: round-off may make the last ones worse.
void ReactionSolver::iterate(bool refines) noexcept {
  const double p = options_.penalty_mass;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  assert(residual_.size() == a_.size() && gamma_.size() == lambda_.size());
  double best = infinite, last = infinite, last_step = infinite;
  for (int pass = 0, idle = 0; pass < most_passes && idle < idle_passes; ++pass) {
    if (pass == 0 || refines) {
      if (pass > 0) f_.residual(a_, lambda_, 0.0, residual_);
      f_.balance(lambda_, residual_);
      f_.constraint_accelerations(a_, gamma_);
      delta_ = -residual_;
    } else {
      gamma_ = work_;
      delta_.setZero();
    }
    f_.solve(delta_, gamma_, p, work_, reaction_slot);
    a_ += delta_;
    lambda_ += p * work_;
    const double size = largest_entry(delta_);
    if (!std::isfinite(size)) break;
    ++idle;
    if (size < 0.9 * best) {
      idle = 0;
      best = size;
      best_a_ = a_;
      best_lambda_ = lambda_;
    }
    const double step = p * largest_entry(work_);
    const double slower = step > 0.0 ? step / last_step : 0.0, rate = std::max(slower, size / last);
    const double rest_a = enough * largest_entry(a_), rest_lambda = enough * largest_entry(lambda_);
    // The change of the next pass would be below rounding, or a multiple of self-balancing forces:
    // contradictions of redundant constraints do not decrease.
    if (size == 0.0 || (pass > 0 && rate * size < rest_a && rate * step < rest_lambda) ||
        (least_ && size < rest_a && slower > slow))
      break;
    last = size;
    last_step = step;
  }
  if (std::isfinite(best)) {
    a_ = best_a_;
    lambda_ = best_lambda_;
  }
}

void ReactionSolver::collect_wrenches() noexcept {
  for (Reactions::Wrench& w : reactions_.joints) w = {};
  f_.add_tree_wrenches(reactions_);
  add_part_wrenches(f_.constraint_set(), lambda_, reactions_);
}

void ReactionSolver::set_impulses(const ConstraintSet& set, const VecX& impulses) noexcept {
  assert(impulses.size() == set.count());
  for (Vec3& x : reactions_.joint_impulses) x.setZero();
  for (Vec3& x : reactions_.element_impulses) x.setZero();
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    const Vec3 on_b = -wrench_on_b(set, k, impulses).F;
    if (p.counted_by() >= 0)
      reactions_.joint_impulses[p.owner.joint] += on_b;
    else
      reactions_.element_impulses[p.owner.element] += on_b;
  }
}

void ReactionSolver::find_open_outputs(const State& start) {
  kinematics_at(f_, start);
  least_->place(f_);
  const Model& model = f_.model();
  const SystemMotion& motion = f_.motion({}, &reactions_);
  const Eigen::Index n = least_->rows();
  for (const Output& o : model.outputs) {
    const OutputOf of = output_kind(o.type).of;
    if (of != OutputOf::reaction && of != OutputOf::rod && of != OutputOf::motion &&
        of != OutputOf::coupling)
      continue;
    VecX part(n);  // of each multiplier in the output
    for (Eigen::Index i = 0; i < n; ++i) {
      FollowedOutput nothing;
      least_->wrenches(VecX::Unit(n, i), reactions_);
      part[i] = output_value(motion, o, nothing);
    }
    VecX held = part;
    least_->project_to_minimum_norm(held);
    if ((part - held).norm() > left_open * part.norm()) open_.push_back(o.name);
  }
}

}  // namespace floatframe
