// A simulation that goes on with another model of the same structure.
#include <fmt/format.h>

#include <utility>

#include "floatframe/model/model_hash.hpp"
#include "floatframe/stepping/same_structure.hpp"
#include "floatframe/stepping/stepping_engine.hpp"

namespace floatframe {
namespace {

/// The model, after its structure and its options have been compared.
const Model& same(const Model& changed, const Model& present) {
  std::string text = structure_complaint(present, changed);
  if (text.empty()) text = option_complaint(present.simulation, changed.simulation);
  if (!text.empty()) throw InputError(ErrorCode::mismatch, "the changed model " + text);
  return changed;
}

StepOptions& with_limits_of(const StepOptions& before, StepOptions& now) {
  now.fixed_iterations = before.fixed_iterations;
  now.time_budget = before.time_budget;
  return now;
}

}  // namespace

Stepper::Stepper(const Model& changed, const SimulationDescription& options, const Stepper& before)
    : start_(changed, options, before.start_),
      f_(start_.formulation()),
      step_options_(start_.step_options()),
      min_step_(before.min_step_),
      integrator_(make_integrator(f_, with_limits_of(before.step_options_, step_options_))),
      input_use_(before.input_use_),
      ticks_(ticks_of(changed)),
      until_(before.until_),
      bounded_(before.bounded_),
      grid_(before.begin(), before.grid_.step(), TimeGrid::endless) {
  require_samples_of_steps(model(), grid_.step());
  if (!bounded_)
    locate_corners(time_corners(model(), {.step = grid_.step(),
                                          .begin = begin(),
                                          .duration = TimeGrid::endless,
                                          .all = before.locator_.has_value()})
                       .located);
  begin_at_start(before.locator_.has_value());
  fit_start();
  set_edge_watch(before.watch_);
  StepperMemory now = before.memory();
  if (now.outputs.size() != outputs_.size() || now.inputs.size() != inputs_.size())
    throw InputError(ErrorCode::mismatch,
                     "found a changed model with other inputs or outputs, "
                     "expected other numbers only");
  now.tangent_reuse = {};  // of the old forces
  set_memory(now);
  f_.set_inputs(inputs_);
  hold_branches();
  integrator_->restart_in_course(state_, grid_.step());
  watch_(state_, integrator_->reactions());
}

/// Accelerations and multipliers of the start with the new forces, where `restart` returns to.
void Stepper::fit_start() {
  f_.set_inputs(first_.inputs);
  hold_branches();
  integrator_->restart_in_course(state_, grid_.step());
  first_ = memory();
}

bool Simulation::Engine::steps_as(const Model& other) {
  if (failed_)
    throw InputError(ErrorCode::step_failed,
                     "found a simulation whose last step failed, expected one that can go on: "
                     "restore an earlier state before the model is changed");
  return model_hash(same(other, model_)) == fingerprint();
}

Simulation::Engine::Engine(const Model& changed, Engine& before)
    : model_(changed), o_(before.o_), steps_(model_, o_, before.steps_), joints_(steps_.model()) {
  name_owners();
  joints_.restore(before.joints_.numbers(), before.joints_.time());
  first_joints_ = before.first_joints_;
  // Nothing throws from here on. Moved, the numbers stay where programs have seen them.
  row_ = std::move(before.row_);
  row_before_ = std::move(before.row_before_);
  inputs_ = std::move(before.inputs_);
  wanted_ = std::move(before.wanted_);
  input_owners_ = std::move(before.input_owners_);
  callback_ = std::move(before.callback_);
  observer_ = std::exchange(before.observer_, nullptr);
  last_ = before.last_;
  last_.where = {};
  inputs_to_formulation();
}

}  // namespace floatframe
