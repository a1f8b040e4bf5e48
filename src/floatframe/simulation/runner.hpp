#pragma once
// Advances any formulation through a run: outputs sampled into a preallocated table, substeps if a
// step does not converge, counters for the summary. Nothing in `advance` or `sample` allocates.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/simulation/corner_steps.hpp"
#include "floatframe/simulation/edge_locator.hpp"
#include "floatframe/simulation/overflow.hpp"
#include "floatframe/simulation/reaction_solver.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/results.hpp"
#include "floatframe/simulation/step_report.hpp"

namespace floatframe {

/// Data of a runner besides the state and the formulation: with it, the next steps and outputs are
/// the same, bit for bit.
struct RunnerMemory {
  TangentReuse tangent_reuse;
  std::vector<FollowedOutput> outputs;
  std::vector<double> inputs;  ///< consistent with the accelerations of the state
  StepCounters counters;
};

template <class F>
class Runner {
 public:
  Runner(F& formulation, const StepOptions& options, double min_step)
      : f_(formulation), integrator_(formulation, options), min_step_(min_step) {
    assert(min_step >= 0.0);
    memory_.outputs.resize(f_.model().outputs.size());
    memory_.inputs.assign(f_.inputs().begin(), f_.inputs().end());
    needs_ = needs_of_outputs(f_.model());
  }
  /// Source of the outputs of reactions; it must outlive this.
  void set_reaction_solver(ReactionSolver& solver) {
    reactions_ = &solver;
    integrator_.keep_impulses();
  }

  /// Divides further steps at the edges of forces; branches are those of the present state.
  void locate_edges() {
    locator_.emplace(f_, integrator_);
    locator_->hold(state_);
  }
  bool locates_edges() const noexcept { return locator_.has_value(); }
  /// Divides further steps, of about this size, at these corners of functions of time.
  void locate_corners(const std::vector<TimeCorner>& corners, double step) {
    if (!corners.empty()) corners_.emplace(f_, integrator_, corners, step);
  }
  std::span<const TimeCorner> corners() const noexcept {
    return corners_ ? std::span<const TimeCorner>(corners_->corners())
                    : std::span<const TimeCorner>();
  }
  /// Inputs that have jumped act as a ramp over the step instead of being constant over it.
  void use_inputs(InputUse use) noexcept { input_use_ = use; }
  InputUse input_use() const noexcept { return input_use_; }

  /// Called at located edges and corners, and at jumps of inputs.
  void set_edge_watch(const EdgeWatch& watch) noexcept {
    watch_ = watch;
    if (locator_) locator_->set_watch(watch);
    if (corners_) corners_->set_watch(watch);
  }

  State& state() noexcept { return state_; }
  const State& state() const noexcept { return state_; }
  /// Multipliers consistent with the accelerations of the last accepted step.
  const VecX& reactions() const noexcept { return integrator_.reactions(); }
  /// The last attempt of the last `advance`.
  const StepAttempt& last() const noexcept { return last_; }

  RunnerMemory memory() const {
    RunnerMemory m = memory_;
    m.tangent_reuse = integrator_.tangent_reuse();
    return m;
  }
  /// `m.outputs` has one entry for each output of the model.
  void set_memory(const RunnerMemory& m) {
    assert(m.outputs.size() == f_.model().outputs.size() && m.inputs.size() == f_.inputs().size());
    memory_ = m;
    integrator_.set_tangent_reuse(m.tangent_reuse);
  }

  /// Advances by h, in substeps if necessary. False: the step did not converge with the smallest
  /// substep.
  bool advance(double h) noexcept {
    assert(h > 0.0 && state_.q.size() == f_.configurations());
    asked_ = h;
    take_inputs(h);
    const double end = state_.t + h;
    const bool divided = locator_ || meets_corner(h);
    StepAttempt r = attempt(h);
    count(r);
    last_ = r;
    if (r.accepted()) {
      ++memory_.counters.steps;
      return true;
    }
    double remaining = divided ? end - state_.t : h, sub = 0.5 * remaining;
    while (remaining > 1e-9 * h) {
      if (sub < min_step_ || !(sub > 0.0)) return false;
      const double now = std::min(sub, remaining);
      r = attempt(now);
      count(r);
      last_ = r;
      if (r.accepted()) {
        remaining -= now;
        ++memory_.counters.substeps;
        if (remaining > 0.0 && sub < 0.5 * h) sub *= 2.0;
      } else {
        sub = 0.5 * now;
        if (divided) remaining = end - state_.t;
      }
    }
    state_.t = end;
    ++memory_.counters.steps;
    return true;
  }
  /// The same with a smallest substep for this step and those after it.
  bool advance(double h, double min_step) noexcept {
    assert(min_step >= 0.0);
    min_step_ = min_step;
    return advance(h);
  }

  /// Writes one row of outputs (time first) at the present state.
  void sample(double* row) noexcept {
    assert(row && state_.q.size() == f_.configurations());
    assert(reactions_ || !needs_.reactions);
    const Model& model = f_.model();
    kinematics_at(f_, state_);
    if (needs_.energies || needs_.reactions)
      f_.dynamics();
    else
      f_.forces();
    if (reactions_) {
      reactions_->solve(state_, f_.inputs(), f_.spring_angles(), f_.force_branches());
      reactions_->set_impulses(f_.constraint_set(), integrator_.impulses());
    }
    f_.set_accelerations(reactions_ ? reactions_->accelerations() : state_.a);
    *row++ = state_.t;
    const SystemMotion& motion = f_.motion(needs_, reactions_ ? &reactions_->reactions() : nullptr);
    for (std::size_t k = 0; k < model.outputs.size(); ++k)
      *row++ = output_value(motion, model.outputs[k], memory_.outputs[k]);
  }

  double kinetic_energy() noexcept { return f_.kinetic_energy(state_.v); }
  /// Gravity and the potential of force elements.
  double potential_energy() noexcept {
    kinematics_at(f_, state_);
    f_.forces();
    double sum = f_.gravity_energy();
    for (std::size_t k = 0; k < f_.model().elements.size(); ++k)
      sum += f_.effort(static_cast<int>(k)).energy;
    return sum;
  }
  /// After `potential_energy`.
  double elastic_energy() const noexcept { return floatframe::elastic_energy(f_.motion()); }

  /// The cause of the last failed step, as a sentence.
  std::string failure() const {
    std::string text = step_failure();  // first: refers to the failed iteration
    const std::string numbers = overflow();
    return numbers.empty() ? text : numbers;
  }

  /// The same from the results of the last iteration.
  std::string step_failure() const {
    if (const std::string text = unreachable_tolerance(); !text.empty()) return text;
    const char* what =
        last_.status == AttemptStatus::singular_tangent ? "the tangent matrix is singular at "
        : last_.status == AttemptStatus::not_finite     ? "the state is no longer finite; look at "
                                                        : "no convergence; look at ";
    const std::string who = last_.constraint >= 0
                                ? f_.constraint_set().owner_of_row(last_.constraint)
                            : last_.coordinate >= 0 ? f_.coordinate_owner(last_.coordinate)
                                                    : "the constraints";
    // An excessive force is a more useful hint than the coordinate it acts on.
    const int force = largest_force();
    std::string text =
        fmt::format("step failed at t = {:.6g} s after substeps down to {:.3g} s: {}{}", state_.t,
                    smallest(), what, who);
    if (force >= 0)
      text += fmt::format(" (largest force: '{}', {:.3g} N)", f_.model().elements[force].name,
                          f_.effort(force).force);
    return text + singular_position();
  }

  /// The rest of the sentence if nearly dependent constraints prevent the step.
  std::string singular_position() const {
    constexpr int most = 1000;  // coordinates; dense linear algebra
    if (last_.status != AttemptStatus::not_converged || f_.constraints() == 0 ||
        f_.velocities() > most || !nearly_dependent(f_.constraint_jacobian()))
      return {};
    return fmt::format(
        "; constraints nearly depend on each other there: next to a singular position where the "
        "mechanism may branch a smaller step or a tolerance above {:g} may pass",
        integrator_.options().tolerance);
  }

  /// Index of the force element with the largest force at the last evaluation; -1: there is none.
  int largest_force() const noexcept {
    double worst = 0.0;
    int force = -1;
    for (std::size_t k = 0; k < f_.model().elements.size(); ++k) {
      const double x = std::abs(f_.effort(static_cast<int>(k)).force);
      if (!(x <= worst)) {
        worst = x;
        force = static_cast<int>(k);
      }
    }
    return force;
  }

  /// The cause of the last failed step if numbers of the model are too large to compute with.
  std::string overflow() const {
    std::string text;
    if (!(asked_ < largest_beside_one))
      text = fmt::format("the step of {:g} s is too long", asked_);
    else
      text = overflow_text(f_, state_, state_.t + min_step_, largest_beside_one);
    if (text.empty()) return text;
    return fmt::format("step failed at t = {:.6g} s after substeps down to {:.3g} s: {}", state_.t,
                       smallest(), overflow_sentence(text, state_.t, largest_beside_one));
  }

  /// The cause of the last failed step if a tolerance needs more digits than double precision has.
  std::string unreachable_tolerance() const {
    if (last_.status != AttemptStatus::not_converged) return {};
    const bool newton = last_.constraint < 0;
    const StepOptions& o = integrator_.options();
    const double tolerance = newton ? o.tolerance : o.position_tolerance;
    const double size = 1.0 + state_.q.lpNorm<Eigen::Infinity>();
    const double least = 1e-15 * size;
    if (!(tolerance < least)) return {};
    return fmt::format(
        "step failed at t = {:.6g} s after substeps down to {:.3g} s: the {} of {:g} is below the "
        "rounding of double precision, about {:.1g} with coordinates up to {:.3g}; expected more",
        state_.t, smallest(), newton ? "tolerance" : "position_tolerance", tolerance, least,
        size - 1.0);
  }

  const StepCounters& counters() const noexcept { return memory_.counters; }

 private:
  StepAttempt attempt(double h) noexcept {
    if (!meets_corner(h)) return smooth(h);
    return corners_->step(
        state_, h, memory_.counters.corners, [this](double size) { return smooth(size); },
        [this] { hold_branches(); });
  }

  /// A step in which no function of time has a corner.
  StepAttempt smooth(double h) noexcept {
    assert(h > 0.0);
    if (!locator_) return integrator_.step(state_, h);
    return locator_->step(state_, h, memory_.counters.edges, memory_.counters.edges_passed);
  }

  bool meets_corner(double h) const noexcept { return corners_ && corners_->within(state_.t, h); }

  /// To be called where forces on fixed branches may jump.
  void hold_branches() noexcept {
    if (locator_) locator_->hold(state_);
  }

  /// Inputs that have jumped since the last step are constant over the whole next one, of size h:
  /// accelerations and multipliers are those of the new values.
  void take_inputs(double h) noexcept {
    const std::span<const double> now = f_.inputs();
    assert(now.size() == memory_.inputs.size());
    if (std::equal(now.begin(), now.end(), memory_.inputs.begin())) return;
    std::copy(now.begin(), now.end(), memory_.inputs.begin());
    if (input_use_ == InputUse::ramp) return;
    hold_branches();
    integrator_.restart_in_course(state_, h);
    watch_(state_, integrator_.reactions());
  }

  /// Last substep that was attempted [s].
  double smallest() const noexcept { return std::min(min_step_, asked_); }

  void count(const StepAttempt& r) noexcept {
    assert(r.iterations >= 0 && r.factorizations >= 0 && r.coordinate < f_.velocities());
    StepCounters& c = memory_.counters;
    c.iterations += r.iterations;
    c.factorizations += r.factorizations;
    if (r.status == AttemptStatus::cut_short) ++c.cut_short;
    if (r.accepted()) {
      c.max_position_violation = std::max(c.max_position_violation, r.position_violation);
      c.max_velocity_violation = std::max(c.max_velocity_violation, r.velocity_violation);
    }
  }

  F& f_;
  AugmentedLagrangian<F> integrator_;
  std::optional<EdgeLocator<F>> locator_;
  std::optional<CornerSteps<F>> corners_;
  EdgeWatch watch_;
  InputUse input_use_ = InputUse::held;
  State state_;
  double min_step_, asked_ = 0.0;
  StepAttempt last_;
  RunnerMemory memory_;
  MotionNeeds needs_;  ///< of the outputs
  ReactionSolver* reactions_ = nullptr;
};

// Compiled once, in runner.cpp: all runs of a formulation use the same arithmetic.
extern template class AugmentedLagrangian<RelativeFormulation>;
extern template class AugmentedLagrangian<AbsoluteFormulation>;
extern template class Runner<RelativeFormulation>;
extern template class Runner<AbsoluteFormulation>;

}  // namespace floatframe
