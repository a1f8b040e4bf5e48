// States of a simulation by names: read, set, and the start again.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/excerpt.hpp"
#include "floatframe/start/closed_state.hpp"
#include "floatframe/stepping/stepping_engine.hpp"

namespace floatframe {
namespace {

/// The number at an index, after it was checked.
template <class Numbers>
double number_of(const Numbers& numbers, const StateName& name) {
  if (name.index < 0 || name.index >= std::ssize(numbers))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("{} '{}': found coordinate {}, expected one of {}", state_kind_name(name.kind),
                    excerpt(name.name), name.index, std::ssize(numbers)));
  return numbers[name.index];
}

[[noreturn]] void unknown(const StateName& name) {
  throw InputError(ErrorCode::not_found,
                   fmt::format("found the {} '{}', which is no coordinate of this model: expected "
                               "a joint, a mode or a state of an element",
                               state_kind_name(name.kind), excerpt(name.name)));
}

}  // namespace

std::vector<double> Simulation::Engine::state_values(std::span<const StateName> names) {
  Formulation& f = steps_.formulation();
  // Joints are followed; all else is where the formulation is, which a restored state leaves.
  if (std::ranges::any_of(names, [](const StateName& n) { return n.kind != StateKind::joint; }))
    kinematics_at(f, steps_.state());
  const SystemMotion& motion = f.motion();
  const auto joint = [&](const StateName& name) {
    for (const SystemState::Joint& j : joints_.joints())
      if (j.name == name.name) return number_of(name.rate ? j.velocity : j.position, name);
    unknown(name);
  };
  const auto mode = [&](const StateName& name) {
    for (std::size_t i = 0; i < model_.bodies.size(); ++i)
      if (model_.bodies[i].name == name.name)
        return number_of(name.rate ? motion.bodies[i].yd : motion.bodies[i].y, name);
    unknown(name);
  };
  const auto element = [&](const StateName& name) {
    for (std::size_t k = 0; k < model_.elements.size(); ++k)
      if (const Element& e = model_.elements[k]; e.name == name.name && e.states > 0 && !name.rate)
        return number_of(Eigen::Map<const VecX>(motion.states[k], e.states), name);
    unknown(name);
  };
  std::vector<double> values;
  for (const StateName& name : names) {
    if (name.kind == StateKind::joint)
      values.push_back(joint(name));
    else if (name.kind == StateKind::mode)
      values.push_back(mode(name));
    else if (name.kind == StateKind::element)
      values.push_back(element(name));
    else
      unknown(name);
  }
  return values;
}

/// A second simulation starts at the state; this one goes on from what is found there.
void Simulation::Engine::set_state(std::span<const GivenState> given) {
  require_idle("set_state");
  SimulationDescription o = o_;
  o.start = Start::state;
  o.state = std::make_shared<SystemState>(closed_state(model_, o_.inertia, state(), given));
  o.velocity.setZero();  // included in the state
  o.offset.clear();
  Model there = model_;
  for (std::size_t k = 0; k < inputs_.size(); ++k) there.inputs[k].initial = inputs_[k];
  const Engine started(there, o);
  StepperMemory memory = started.steps_.memory();
  memory.counters = counters();
  steps_.set_memory(memory);
  joints_.restore(started.joints_.numbers(), started.joints_.time());
  row_ = started.row_;
  inputs_to_formulation();
  sample();
  go_on();
  begin_observation(StepsBegin::again);
}

void Simulation::Engine::reset() {
  require_idle("reset");
  steps_.restart();
  for (std::size_t k = 0; k < inputs_.size(); ++k) inputs_[k] = model_.inputs[k].initial;
  inputs_to_formulation();
  joints_.restore(first_joints_, steps_.state().t);
  sample();
  go_on();
  begin_observation(StepsBegin::again);
}

void Simulation::Engine::observe(StepObserver* observer) {
  if (observer) require_idle("observe");
  if (observer && observer_)
    throw InputError(ErrorCode::in_use,
                     "found a simulation that is recorded, expected one recording at a time");
  if (!observer) steps_.set_edge_watch({});
  observer_ = observer;
  try {
    begin_observation(StepsBegin::here);
  } catch (...) {
    observer_ = nullptr;
    throw;
  }
}

void Simulation::Engine::begin_observation(StepsBegin why) {
  if (observer_) observer_->begin(steps_, row_, why);
}

}  // namespace floatframe
