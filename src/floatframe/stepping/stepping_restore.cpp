// Saving and restoring a simulation.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/model/model_hash.hpp"
#include "floatframe/stepping/memory_check.hpp"
#include "floatframe/stepping/stepping_engine.hpp"

namespace floatframe {
namespace {

struct NamedNumbers {
  const char* name;
  std::span<const double> given, own;
};

/// Options that determine the steps: name, found, expected.
struct NamedOption {
  const char* name;
  double given, own;
};

}  // namespace

const std::string& Simulation::Engine::fingerprint() {
  if (fingerprint_.empty()) fingerprint_ = model_hash(model_);
  return fingerprint_;
}

std::shared_ptr<SimulationState::Data> Simulation::Engine::present() {
  auto data = std::make_shared<SimulationState::Data>();
  data->fingerprint = fingerprint();
  data->coordinates = static_cast<std::int64_t>(o_.coordinates);
  data->inertia = static_cast<std::int64_t>(o_.inertia);
  data->max_iterations = o_.max_iterations;
  data->locate_edges = o_.locate_edges ? 1 : 0;
  data->input = static_cast<std::int64_t>(o_.input);
  data->step = o_.step;
  data->spectral_radius = o_.spectral_radius;
  data->tolerance = o_.tolerance;
  data->min_step = o_.min_step;
  data->penalty = o_.penalty;
  data->position_tolerance = o_.position_tolerance;
  data->velocity_tolerance = o_.velocity_tolerance;
  data->inputs = inputs_;
  data->row = row_;
  data->steps = steps_.memory();
  data->joints = joints_.numbers();
  data->joints_time = joints_.time();
  return data;
}

SimulationState Simulation::Engine::save() {
  require_idle("save");
  if (failed_)
    throw InputError(ErrorCode::step_failed,
                     "found a simulation whose last step failed, expected one that can go on: save "
                     "before, or restore an earlier state");
  return SimulationState(present());
}

std::string Simulation::Engine::complaint(const SimulationState::Data& d,
                                          const SimulationState::Data& own) {
  if (d.fingerprint != own.fingerprint) return "is of another model";
  for (const NamedOption& x : std::initializer_list<NamedOption>{
           {"coordinates", static_cast<double>(d.coordinates),
            static_cast<double>(own.coordinates)},
           {"inertia", static_cast<double>(d.inertia), static_cast<double>(own.inertia)},
           {"max_iterations", static_cast<double>(d.max_iterations),
            static_cast<double>(own.max_iterations)},
           {"locate_edges", static_cast<double>(d.locate_edges),
            static_cast<double>(own.locate_edges)},
           {"input", static_cast<double>(d.input), static_cast<double>(own.input)},
           {"step", d.step, own.step},
           {"spectral_radius", d.spectral_radius, own.spectral_radius},
           {"tolerance", d.tolerance, own.tolerance},
           {"min_step", d.min_step, own.min_step},
           {"penalty", d.penalty, own.penalty},
           {"position_tolerance", d.position_tolerance, own.position_tolerance},
           {"velocity_tolerance", d.velocity_tolerance, own.velocity_tolerance}})
    if (!(x.given == x.own))
      return fmt::format("was made with another option '{}': found {:g}, this simulation has {:g}",
                         x.name, x.given, x.own);
  if (const std::string text = memory_complaint(d.steps, own.steps, steps_.formulation(), d.step);
      !text.empty())
    return text;
  const auto damaged = [](const char* name, const char* what) {
    return fmt::format("is damaged: {} {}", name, what);
  };
  for (const NamedNumbers& x :
       std::initializer_list<NamedNumbers>{{"inputs", d.inputs, own.inputs},
                                           {"joint coordinates", d.joints, own.joints},
                                           {"outputs", d.row, own.row}}) {
    if (x.given.size() != x.own.size()) return damaged(x.name, "of another number");
    if (x.given.data() != d.row.data() && !all_finite(x.given))
      return damaged(x.name, "that are not finite");
  }
  for (std::size_t k = 0; k < d.inputs.size(); ++k)
    if (accepted_value(model_.inputs[k], d.inputs[k]) != d.inputs[k])
      return damaged("inputs", "outside of their limits");
  if (!std::isfinite(d.joints_time) || d.row[0] != d.steps.state.t)
    return damaged("times or counters", "that do not fit together");
  return {};
}

void Simulation::Engine::restore(const SimulationState& state) {
  require_idle("restore");
  if (state.empty())
    throw InputError(ErrorCode::missing,
                     "found a saved state that is empty, expected one of a simulation");
  const SimulationState::Data& given = *state.data_;
  if (const std::string text = complaint(given, *present()); !text.empty())
    throw InputError(ErrorCode::mismatch, "the saved state " + text);
  inputs_ = given.inputs;
  row_ = given.row;
  steps_.set_memory(given.steps);
  joints_.restore(given.joints, given.joints_time);
  inputs_to_formulation();
  go_on();
  begin_observation(StepsBegin::again);
}

}  // namespace floatframe
