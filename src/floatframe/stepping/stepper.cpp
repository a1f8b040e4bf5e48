#include "floatframe/stepping/stepper.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/loops/run_error.hpp"

namespace floatframe {
namespace {

StepOptions limited(StepOptions options, const StepLimits& limits) {
  options.fixed_iterations = limits.fixed_iterations;
  options.time_budget = limits.time_budget;
  return options;
}

std::string open_outputs_note(const std::vector<std::string>& names) {
  return named_text("output", "outputs", names) + (names.size() == 1 ? " is" : " are") +
         " not unique, since constraints are redundant: of the reactions that are possible those "
         "of least norm are given";
}

}  // namespace

Stepper::Stepper(const Model& model, const SimulationDescription& options, const StepLimits& limits)
    : start_(model, options),
      f_(start_.formulation()),
      step_options_(limited(start_.step_options(), limits)),
      min_step_(limits.min_step.value_or(start_.min_step())),
      integrator_(make_integrator(f_, step_options_)),
      input_use_(options.input),
      ticks_(ticks_of(model)),
      until_(limits.until && model.until),
      bounded_(limits.bounded),
      grid_(start_.state().t, options.step, limits.duration) {
  require_samples_of_steps(this->model(), grid_.step());
  if (std::string note = settle_samples(start_, options.step); !note.empty())
    start_.add_note(std::move(note));
  find_corners(options, limits);
  begin_at_start(options.locate_edges && !limits.bounded);
  if (reactions_ && !reactions_->open_outputs().empty())
    start_.add_note(open_outputs_note(reactions_->open_outputs()));
  if (options.until && limits.bounded)
    start_.add_note("until is ignored here: steps go on where its formula crosses zero");
  if (options.locate_edges && limits.bounded)
    start_.add_note("locate_edges is ignored here: it would make the number of substeps unbounded");
}

Stepper::Stepper(const Stepper& found, double duration)
    : start_(found.start_),
      f_(start_.formulation()),
      step_options_(found.step_options_),
      min_step_(found.min_step_),
      integrator_(make_integrator(f_, step_options_)),
      input_use_(found.input_use_),
      ticks_(found.ticks_),
      until_(found.until_),
      bounded_(found.bounded_),
      grid_(start_.state().t, found.grid_.step(), duration) {
  if (found.corners_) locate_corners({found.corners().begin(), found.corners().end()});
  begin_at_start(found.locator_.has_value());
}

void Stepper::find_corners(const SimulationDescription& o, const StepLimits& limits) {
  TimeCorners found = time_corners(
      model(),
      {.step = o.step, .begin = begin(), .duration = limits.duration, .all = o.locate_edges});
  // What is stepped without an end may not get there.
  if (!found.jumps.empty() && std::isfinite(limits.duration))
    throw RunError(ErrorCode::contradiction, found.jumps.front());
  for (std::string& note : found.jumps) start_.add_note(std::move(note));
  if (!limits.bounded) locate_corners(found.located);
  for (std::string& note : found.velocity_jumps) start_.add_note(std::move(note));
  for (std::string& note : limits.bounded ? found.passed : found.dense)
    start_.add_note(std::move(note));
}

void Stepper::locate_corners(const std::vector<TimeCorner>& corners) {
  std::vector<FormulaOfTime> formulas = formulas_of_time(model());
  if (!corners.empty() || !ticks_.empty() || !formulas.empty())
    corners_.emplace(f_, *integrator_, corners, ticks_, std::move(formulas), grid_.step());
}

void Stepper::begin_at_start(bool locate_edges) {
  assert(min_step_ >= 0.0);
  needs_ = needs_of_outputs(model());
  outputs_ = followed_outputs(model().outputs);
  samples_ = Samples(model());
  inputs_.assign(f_.inputs().begin(), f_.inputs().end());
  state_ = start_.state();
  if (locate_edges) locator_.emplace(f_, *integrator_);
  watch_formulas();
  prepare_reactions();
  hold_branches();
  look_at_formulas();
  note_crossings();
  first_ = memory();
  for (const Element& e : model().elements) may_throw_ = may_throw_ || calls_program(e.type);
  if (may_throw_ || !watched_.empty())
    before_ = {.state = state_,
               .angles = {f_.spring_angles().begin(), f_.spring_angles().end()},
               .branches = {f_.force_branches().begin(), f_.force_branches().end()},
               .outputs = outputs_,
               .tangent_reuse = integrator_->tangent_reuse(),
               .inputs = inputs_,
               .counters = counters_};
}

void Stepper::prepare_reactions() {
  if (!(needs_ | samples_.needs() | watched_needs_).reactions) return;
  reactions_.emplace(f_.coordinates(), model(), start_.inertia(), start_.state(),
                     ReactionOptions{step_options_.penalty_mass, grid_.step(),
                                     !start_.report().redundant.empty()});
  integrator_->keep_impulses();
}

std::span<const TimeCorner> Stepper::corners() const noexcept {
  if (!corners_) return {};
  return corners_->corners();
}

void Stepper::set_edge_watch(const EdgeWatch& watch) noexcept {
  watch_ = watch;
  if (locator_) locator_->set_watch(watch);
  if (corners_) corners_->set_watch(watch);
}

bool Stepper::advance(const PlannedStep& step) noexcept {
  assert(step.size > 0.0 && step.to > state_.t);
  least_ = min_step_ * std::max(1.0, step.size / grid_.step());
  if (before_) keep(*before_);
  bool good = cover(step.size);
  if (good) {
    state_.t = step.to;
    good = watched_.empty() || look_for_crossings(step);
  }
  if (!good) {
    if (may_throw_ && has_thrown()) undo();
    return false;
  }
  if (!ended_) grid_.made(step);
  return true;
}

void Stepper::keep(Before& before) const noexcept {
  before.state = state_;
  before.base = grid_.base();
  before.since_base = grid_.since_base();
  std::copy(outputs_.begin(), outputs_.end(), before.outputs.begin());
  std::copy(inputs_.begin(), inputs_.end(), before.inputs.begin());
  before.tangent_reuse = integrator_->tangent_reuse();
  before.counters = counters_;
  std::copy(f_.spring_angles().begin(), f_.spring_angles().end(), before.angles.begin());
  std::copy(f_.force_branches().begin(), f_.force_branches().end(), before.branches.begin());
}

void Stepper::undo() noexcept {
  assert(before_);
  state_ = before_->state;
  f_.set_spring_angles(before_->angles);
  f_.hold_force_branches(before_->branches);
  std::copy(before_->outputs.begin(), before_->outputs.end(), outputs_.begin());
  grid_.restore(before_->base, before_->since_base);
}

/// Moves the state by h, in substeps if necessary. False: an attempt with the smallest substep did
/// not converge.
bool Stepper::cover(double h) noexcept {
  assert(h > 0.0 && state_.q.size() == f_.configurations());
  asked_ = h;
  ticked_ = -TimeGrid::endless;
  undefined_ = false;
  if (locator_) locator_->begin();
  take_inputs(h);
  if (has_thrown()) return false;
  const double end = state_.t + h;
  const bool divided = locator_ || (corners_ && corners_->within(state_.t, h));
  count(last_ = part(h, true));
  if (last_.accepted()) {
    if (locator_) locator_->end(state_, counters_.edges_passed);
    sample_elements(h);
    if (undefined_) return false;
    take_samples();
    ++counters_.steps;
    return true;
  }
  double remaining = divided ? end - state_.t : h, sub = 0.5 * remaining;
  while (remaining > 1e-9 * h) {
    if (has_thrown() || undefined_ || sub < least_ || !(sub > 0.0)) return false;
    const double now = std::min(sub, remaining);
    count(last_ = part(now, true));
    if (last_.accepted()) {
      sample_elements(h);
      if (undefined_) return false;
      take_samples();
      remaining -= now;
      ++counters_.substeps;
      if (remaining > 0.0 && sub < 0.5 * h) sub *= 2.0;
    } else {
      sub = 0.5 * now;
      if (divided) remaining = end - state_.t;
    }
  }
  state_.t = end;
  if (locator_) locator_->end(state_, counters_.edges_passed);
  ++counters_.steps;
  return true;
}

bool Stepper::has_thrown() noexcept {
  if (f_.thrown().element < 0) return false;
  last_.status = AttemptStatus::law_failed;
  return true;
}

StepAttempt Stepper::part(double h, bool may_meet_corner) noexcept {
  assert(h > 0.0);
  if (may_meet_corner && corners_ && corners_->within(state_.t, h))
    return corners_->step(
        state_, h, counters_.corners, [this](double size) { return part(size, false); },
        [this] {
          if (!take_ticks()) return false;
          hold_branches();
          return true;
        });
  if (!locator_) return integrator_->attempt(state_, h);
  return locator_->step(state_, h, counters_.edges);
}

/// To be called where forces on fixed branches may jump.
void Stepper::hold_branches() noexcept {
  if (locator_) locator_->hold(state_);
}

/// Inputs that have jumped since the last step are constant over the whole next one, of size h:
/// accelerations and multipliers are those of the new values. As a ramp they need nothing.
void Stepper::take_inputs(double h) noexcept {
  const std::span<const double> now = f_.inputs();
  assert(now.size() == inputs_.size());
  if (std::equal(now.begin(), now.end(), inputs_.begin())) return;
  std::copy(now.begin(), now.end(), inputs_.begin());
  if (input_use_ == InputUse::ramp) return;
  hold_branches();
  integrator_->restart_in_course(state_, h);
  watch_(state_, integrator_->reactions());
}

/// At the end of a step of size h: forces jump there as those of inputs do.
void Stepper::sample_elements(double h) noexcept {
  const double width = time_corner_width * grid_.step();
  const bool due = std::any_of(ticks_.begin(), ticks_.end(),
                               [&](const SampleTicks& x) { return x.at(state_.t, width); });
  if (!due || state_.t - ticked_ < width) return;
  if (watch_.look) {
    kinematics_at(f_, state_);
    f_.forces();
    watch_(state_, integrator_->reactions());
  }
  if (!take_ticks()) return;
  hold_branches();
  integrator_->restart_in_course(state_, h);
  watch_(state_, integrator_->reactions());
}

/// Sampled elements at the present instant. False: one of their values is not a number; steps end
/// there.
bool Stepper::take_ticks() noexcept {
  if (ticks_.empty()) return true;
  take_samples();
  ticked_ = state_.t;
  kinematics_at(f_, state_);
  f_.sample_elements(time_corner_width * grid_.step());
  undefined_ = !f_.element_states().values().allFinite();
  if (undefined_)
    last_.status = AttemptStatus::not_finite;
  else
    state_.z = f_.element_states().values();
  return !undefined_;
}

void Stepper::count(const StepAttempt& r) noexcept {
  assert(r.iterations >= 0 && r.factorizations >= 0 && r.coordinate < f_.velocities());
  counters_.iterations += r.iterations;
  counters_.factorizations += r.factorizations;
  if (r.status == AttemptStatus::cut_short) ++counters_.cut_short;
  if (!r.accepted()) return;
  counters_.max_load_contraction = std::max(counters_.max_load_contraction, r.load_contraction);
  counters_.max_position_violation =
      std::max(counters_.max_position_violation, r.position_violation);
  counters_.max_velocity_violation =
      std::max(counters_.max_velocity_violation, r.velocity_violation);
}

void Stepper::sample(double* row) noexcept {
  assert(row && state_.q.size() == f_.configurations());
  *row++ = state_.t;
  const SystemMotion& motion = present_motion(needs_);
  for (std::size_t k = 0; k < model().outputs.size(); ++k)
    *row++ = output_value(motion, model().outputs[k], outputs_[k]);
}

const SystemMotion& Stepper::present_motion(MotionNeeds needs) noexcept {
  assert(reactions_ || !needs.reactions);
  kinematics_at(f_, state_);
  if (needs.energies || needs.reactions)
    f_.dynamics();
  else
    f_.forces();
  if (needs.reactions) {
    reactions_->solve(state_, f_.inputs(), f_.spring_angles(), f_.force_branches());
    reactions_->set_impulses(f_.constraint_set(), integrator_->impulses());
  }
  f_.set_accelerations(needs.reactions ? reactions_->accelerations() : state_.a);
  return f_.motion(needs, needs.reactions ? &reactions_->reactions() : nullptr);
}

/// Of outputs that formulas refer to, which they keep until the end of the next step.
void Stepper::take_samples() noexcept {
  if (!samples_.empty()) samples_.take(present_motion(samples_.needs()), state_.z);
}

Energies Stepper::energies() noexcept {
  kinematics_at(f_, state_);
  f_.forces();
  Energies e;
  e.potential = f_.gravity_energy();
  for (std::size_t k = 0; k < model().elements.size(); ++k) e.potential += f_.effort(k).energy;
  e.elastic = elastic_energy(f_.motion());
  e.kinetic = f_.kinetic_energy(state_.v);
  return e;
}

SystemState Stepper::system_state(JointFollower& joints) {
  kinematics_at(f_, state_);
  SystemState s = floatframe::system_state(f_.motion(), joints);
  place_bodies(model(), start_.inertia(), s);
  return s;
}

StepperMemory Stepper::memory() const {
  StepperMemory m;
  m.base = grid_.base();
  m.since_base = grid_.since_base();
  m.state = state_;
  m.spring_angles.assign(f_.spring_angles().begin(), f_.spring_angles().end());
  if (locator_) m.force_branches.assign(f_.force_branches().begin(), f_.force_branches().end());
  m.tangent_reuse = integrator_->tangent_reuse();
  m.outputs = outputs_;
  m.inputs = inputs_;
  m.counters = counters_;
  return m;
}

void Stepper::set_memory(const StepperMemory& m) {
  assert(m.state.q.size() == f_.configurations() && m.state.v.size() == f_.velocities());
  assert(m.state.lambda.size() == f_.constraints());
  assert(m.outputs.size() == outputs_.size() && m.inputs.size() == inputs_.size());
  grid_.restore(m.base, m.since_base);
  f_.stepping(true);  // what a law has thrown is forgotten
  f_.stepping(false, true);
  state_ = m.state;
  f_.set_spring_angles(m.spring_angles);
  if (locator_) f_.hold_force_branches(m.force_branches);
  integrator_->set_tangent_reuse(m.tangent_reuse);
  outputs_ = m.outputs;
  inputs_ = m.inputs;
  counters_ = m.counters;
  ended_ = false;
}

}  // namespace floatframe
