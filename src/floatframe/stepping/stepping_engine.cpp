// Steps, inputs and the force callback of a simulation.
#include "floatframe/stepping/stepping_engine.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/formulation/owners.hpp"
#include "floatframe/tangents/overflow.hpp"

namespace floatframe {
namespace {

/// For the step of the options. Squares of smaller ones vanish compared with the masses.
constexpr double smallest_part = 1e-9;

}  // namespace

const char* step_status_name(StepStatus status) noexcept {
  static constexpr const char* names[] = {
      "completed",     "not_converged", "singular_tangent", "not_finite",      "law_failed",
      "failed_before", "invalid_step",  "invalid_input",    "callback_failed", "busy"};
  const std::size_t k = index_of(status);
  return k < std::size(names) ? names[k] : "unknown";
}

Simulation::Engine::Engine(const Model& model, const SimulationDescription& options)
    : model_(model),
      o_(options),
      steps_(model_, o_),
      joints_(steps_.model()),
      row_(model.outputs.size() + 1, 0.0),
      row_before_(row_) {
  for (const Input& input : model_.inputs) {
    inputs_.push_back(input.initial);
    input_owners_.push_back("input '" + input.name + "'");
  }
  wanted_ = inputs_;
  name_owners();
  sample();
  first_joints_ = joints_.numbers();
}

void Simulation::Engine::name_owners() {
  owners_ = coordinate_owners(steps_.formulation());
  for (std::string& owner : constraint_owners(steps_.formulation()))
    owners_.push_back(std::move(owner));
  for (const Element& force : model_.elements) owners_.push_back("force '" + force.name + "'");
}

void Simulation::Engine::sample() noexcept {
  steps_.sample(row_.data());
  joints_.follow(steps_.formulation().motion());
}

SystemState Simulation::Engine::state() {
  // Uses the data of the last step: it need not be tracked again.
  JointFollower joints = joints_;
  return steps_.system_state(joints);
}

void Simulation::Engine::require_idle(const char* what) const {
  if (busy_)
    throw InputError(ErrorCode::in_use,
                     fmt::format("found a call of {} by the force callback, expected it outside of "
                                 "a step: the callback may change the inputs it is given",
                                 what));
}

StepReport Simulation::Engine::refused(StepStatus status, std::string_view where) noexcept {
  StepReport r;
  r.status = status;
  r.where = where;
  r.time = time();
  if (status != StepStatus::busy && status != StepStatus::failed_before) last_ = r;
  return r;
}

StepStatus Simulation::Engine::call_back(std::string_view& where) noexcept {
  wanted_ = inputs_;  // of the same size: no allocation
  busy_ = true;
  thrown_ = nullptr;
  try {
    callback_(time(), outputs(), wanted_);
  } catch (...) {
    thrown_ = std::current_exception();
  }
  busy_ = false;
  if (thrown_) return StepStatus::callback_failed;
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    const auto value = accepted_value(model_.inputs[k], wanted_[k]);
    if (!value) {
      refused_value_ = wanted_[k];
      where = input_owners_[k];
      return StepStatus::invalid_input;
    }
    wanted_[k] = *value;
  }
  inputs_.swap(wanted_);
  inputs_to_formulation();
  return StepStatus::completed;
}

StepReport Simulation::Engine::make(const PlannedStep& step) noexcept {
  if (busy_) return refused(StepStatus::busy);
  if (failed_) return refused(StepStatus::failed_before, last_.where);
  if (!(step.size >= smallest_part * o_.step) || !std::isfinite(step.to) || !(step.to > time())) {
    refused_value_ = step.size;
    return refused(StepStatus::invalid_step);
  }
  if (callback_) {
    std::string_view where;
    if (const StepStatus s = call_back(where); s != StepStatus::completed) return refused(s, where);
  }
  const StepCounters before = counters();
  const bool timed = observer_ && observer_->timed();
  const Nanoseconds begun = timed ? thread_cpu_clock() : 0;
  bool good = steps_.advance(step);
  if (good) {
    if (steps_.may_throw()) row_before_ = row_;
    sample();
    good = !steps_.has_thrown();
    if (!good) {
      steps_.undo();
      row_ = row_before_;
    }
  }  // else the formulation remains at the failed iteration for diagnosis
  const StepCounters after = counters();
  last_ = StepReport();
  last_.iterations = static_cast<int>(after.iterations - before.iterations);
  last_.factorizations = static_cast<int>(after.factorizations - before.factorizations);
  last_.substeps = static_cast<int>(after.substeps - before.substeps);
  last_.position_violation = steps_.last().position_violation;
  last_.velocity_violation = steps_.last().velocity_violation;
  last_.time = time();
  if (good) {
    if (observer_) observer_->step(steps_, row_, step, timed ? thread_cpu_clock() - begun : 0);
    return last_;
  }
  failed_ = true;
  sentence_.clear();
  explain(last_);
  if (observer_) observer_->failed(steps_);
  return last_;
}

void Simulation::Engine::explain(StepReport& report) const noexcept {
  const StepAttempt& a = steps_.last();
  const Formulation& f = steps_.formulation();
  report.status = a.status == AttemptStatus::singular_tangent ? StepStatus::singular_tangent
                  : a.status == AttemptStatus::not_finite     ? StepStatus::not_finite
                  : a.status == AttemptStatus::law_failed     ? StepStatus::law_failed
                                                              : StepStatus::not_converged;
  report.time = steps_.state().t;  // end of the accepted part
  const int thrown = f.thrown().element, force = thrown >= 0 ? thrown : steps_.largest_force();
  if (thrown >= 0)
    report.where = owners_[f.velocities() + f.constraints() + thrown];
  else if (a.constraint >= 0)
    report.where = owners_[f.velocities() + a.constraint];
  else if (a.coordinate >= 0)
    report.where = owners_[a.coordinate];
  else if (force >= 0)
    report.where = owners_[f.velocities() + f.constraints() + force];
}

std::string Simulation::Engine::failure() {
  switch (last_.status) {
    case StepStatus::completed:
    case StepStatus::failed_before:
    case StepStatus::busy:
      return {};
    case StepStatus::invalid_step:
      return fmt::format(
          "found a step of {:g} s at t = {:.9g} s, expected a positive number [s] of at least {:g} "
          "that is not lost in the rounding of the time",
          refused_value_, last_.time, smallest_part * o_.step);
    case StepStatus::invalid_input:
      for (std::size_t k = 0; k < input_owners_.size(); ++k)
        if (last_.where == input_owners_[k])
          return fmt::format("{}: the force callback gave {:g} at t = {:.9g} s, expected {}",
                             input_owners_[k], refused_value_, last_.time,
                             input_expectation(model_.inputs[k]));
      return {};
    case StepStatus::callback_failed:
      return fmt::format("the force callback threw an exception at t = {:.9g} s: {}", last_.time,
                         thrown_text(thrown_));
    case StepStatus::not_converged:
    case StepStatus::singular_tangent:
    case StepStatus::not_finite:
    case StepStatus::law_failed:
      break;
  }
  // Once: finding the cause moves the formulation.
  if (sentence_.empty()) sentence_ = steps_.failure();
  return sentence_;
}

void Simulation::Engine::set_input(std::size_t k, double value) {
  const auto accepted = accepted_value(model_.inputs[k], value);
  if (!accepted)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("{}: found {:g}, expected {}", input_owners_[k], value,
                                 input_expectation(model_.inputs[k])));
  inputs_[k] = *accepted;
  inputs_to_formulation();
}

void Simulation::Engine::on_force(ForceCallback callback) {
  require_idle("on_force");
  callback_ = std::move(callback);
}

}  // namespace floatframe
