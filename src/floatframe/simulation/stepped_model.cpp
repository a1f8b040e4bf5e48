#include "floatframe/simulation/stepped_model.hpp"

#include <algorithm>
#include <cassert>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/light_motion.hpp"
#include "floatframe/simulation/positive_mass.hpp"

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

template <class F>
SteppedModel<F>::SteppedModel(const Model& model, const SimulationDescription& options,
                              const StepLimits& limits)
    : start_(model, options, F::coordinates_of),
      f_(static_cast<F&>(start_.formulation())),
      step_options_(limited(start_.step_options(), limits)),
      min_step_(limits.min_step.value_or(start_.min_step())),
      runner_(f_, step_options_, min_step_),
      grid_(start_.state().t, options.step, limits.duration) {
  find_corners(options, limits);
  runner_.use_inputs(options.input);
  begin_at_start(options.locate_edges && !limits.bounded);
  prepare_reactions();
  if (reactions_ && !reactions_->open_outputs().empty())
    start_.add_note(open_outputs_note(reactions_->open_outputs()));
  if (options.locate_edges && limits.bounded)
    start_.add_note("locate_edges is ignored here: it would make the number of substeps unbounded");
}

template <class F>
SteppedModel<F>::SteppedModel(const SteppedModel& found, double duration)
    : start_(found.start_),
      f_(static_cast<F&>(start_.formulation())),
      step_options_(found.step_options_),
      min_step_(found.min_step_),
      runner_(f_, step_options_, min_step_),
      grid_(start_.state().t, found.grid_.step(), duration) {
  runner_.locate_corners({found.corners().begin(), found.corners().end()}, grid_.step());
  runner_.use_inputs(found.runner_.input_use());
  begin_at_start(found.runner_.locates_edges());
  prepare_reactions();
}

template <class F>
void SteppedModel<F>::find_corners(const SimulationDescription& o, const StepLimits& limits) {
  TimeCorners found = time_corners(
      model(),
      {.step = o.step, .begin = begin(), .duration = limits.duration, .all = o.locate_edges});
  if (!limits.bounded) runner_.locate_corners(found.located, o.step);
  for (std::string& note : found.velocity_jumps) start_.add_note(std::move(note));
  for (std::string& note : limits.bounded ? found.passed : found.dense)
    start_.add_note(std::move(note));
}

template <class F>
void SteppedModel<F>::begin_at_start(bool locate_edges) {
  runner_.state() = start_.state();
  if (locate_edges) runner_.locate_edges();
  first_ = memory();
}

template <class F>
void SteppedModel<F>::prepare_reactions() {
  if (!needs_of_outputs(model()).reactions) return;
  reactions_.emplace(f_.coordinates(), model(), start_.inertia(), start_.state(),
                     ReactionOptions{step_options_.penalty_mass, grid_.step(),
                                     !start_.report().redundant.empty()});
  runner_.set_reaction_solver(*reactions_);
}

template <class F>
bool SteppedModel<F>::advance(const PlannedStep& step) noexcept {
  assert(step.size > 0.0 && step.to > state().t);
  if (!runner_.advance(step.size, min_step_ * std::max(1.0, step.size / grid_.step())))
    return false;
  runner_.state().t = step.to;
  grid_.made(step);
  return true;
}

template <class F>
void SteppedModel<F>::sample(double* row) noexcept {
  runner_.sample(row);
}

template <class F>
Energies SteppedModel<F>::energies() noexcept {
  Energies e;
  e.potential = runner_.potential_energy();  // brings the formulation to the state
  e.elastic = runner_.elastic_energy();
  e.kinetic = runner_.kinetic_energy();
  return e;
}

/// `lost_mass` of the first body with a message.
std::string lost_masses(const SystemMotion& motion) {
  for (std::size_t i = 0; i < motion.bodies.size(); ++i)
    if (std::string text = lost_mass(motion.model.bodies[i], motion.bodies[i].y); !text.empty())
      return text;
  return {};
}

template <class F>
std::string SteppedModel<F>::failure() {
  const std::string text = runner_.failure();  // first: refers to the failed iteration
  kinematics_at(f_, runner_.state());
  const std::string lost = lost_masses(f_.motion());
  return text + (lost.empty() ? light_motion_note(f_, runner_.state()) : "; " + lost);
}

template <class F>
SystemState SteppedModel<F>::system_state(JointFollower& joints) {
  kinematics_at(f_, runner_.state());
  SystemState s = floatframe::system_state(f_.motion(), joints);
  place_bodies(model(), start_.inertia(), s);
  return s;
}

template <class F>
SteppedMemory SteppedModel<F>::memory() const {
  SteppedMemory m;
  m.base = grid_.base();
  m.since_base = grid_.since_base();
  m.state = runner_.state();
  m.spring_angles.assign(f_.spring_angles().begin(), f_.spring_angles().end());
  if (runner_.locates_edges())
    m.force_branches.assign(f_.force_branches().begin(), f_.force_branches().end());
  m.runner = runner_.memory();
  return m;
}

template <class F>
void SteppedModel<F>::set_memory(const SteppedMemory& m) {
  assert(m.state.q.size() == f_.configurations() && m.state.v.size() == f_.velocities());
  assert(m.state.lambda.size() == f_.constraints());
  grid_.restore(m.base, m.since_base);
  runner_.state() = m.state;
  f_.set_spring_angles(m.spring_angles);
  if (runner_.locates_edges()) f_.hold_force_branches(m.force_branches);
  runner_.set_memory(m.runner);
}

template class SteppedModel<RelativeFormulation>;
template class SteppedModel<AbsoluteFormulation>;

}  // namespace floatframe
