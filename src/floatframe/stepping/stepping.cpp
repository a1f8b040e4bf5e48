#include "floatframe/stepping/stepping.hpp"

#include <fmt/format.h>

#include "floatframe/core/excerpt.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/stepping/simulation_options.hpp"
#include "floatframe/stepping/stepping_engine.hpp"

namespace floatframe {

namespace {

template <class Entity>
std::vector<std::string> names_of(const std::vector<Entity>& list) {
  std::vector<std::string> names;
  for (const Entity& e : list) names.push_back(e.name);
  return names;
}

template <class Entity>
std::size_t place_of(const std::vector<Entity>& list, const char* kind, std::string_view name) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list[k].name == name) return k;
  throw InputError(ErrorCode::not_found, fmt::format("unknown {} '{}'{}", kind, excerpt(name),
                                                     did_you_mean(name, names_of(list))));
}

template <class Entity>
std::size_t place_of(const std::vector<Entity>& list, const char* kind, std::ptrdiff_t index) {
  const auto n = static_cast<std::ptrdiff_t>(list.size());
  if (index >= 0 && index < n) return index;
  if (n == 0)
    throw InputError(
        ErrorCode::missing,
        fmt::format("found index {} of an {}, but the model has no {}s", index, kind, kind));
  throw InputError(ErrorCode::out_of_range,
                   fmt::format("found index {} of an {}, expected 0 to {}", index, kind, n - 1));
}

}  // namespace

Simulation::Simulation(const Model& model, const SimulationOptions& options) {
  engine_ = std::make_unique<Engine>(model, described(built(model), options));
}

Simulation::~Simulation() = default;

const Model& Simulation::model() const noexcept { return engine_->model(); }
const SimulationDescription& Simulation::options() const noexcept { return engine_->options(); }
const StartReport& Simulation::start_report() const noexcept { return engine_->start_report(); }
StepReport Simulation::step() noexcept { return engine_->make(engine_->grid().next()); }
StepReport Simulation::step(double size) noexcept {
  return engine_->make(engine_->grid().of_size(size, time()));
}
std::exception_ptr Simulation::thrown() const noexcept { return engine_->thrown(); }
std::string Simulation::failure() const { return engine_->failure(); }
double Simulation::time() const noexcept { return engine_->time(); }
StepCounters Simulation::counters() const noexcept { return engine_->counters(); }
SystemState Simulation::state() const {
  engine_->require_idle("state");
  return engine_->state();
}

std::vector<double> Simulation::state_values(std::span<const StateName> names) const {
  return engine_->state_values(names);
}
void Simulation::set_state(std::span<const GivenState> given) { engine_->set_state(given); }
void Simulation::reset() { engine_->reset(); }
void Simulation::observe(StepObserver* observer) { engine_->observe(observer); }

std::vector<std::string> Simulation::input_names() const { return names_of(model().inputs); }
std::span<const double> Simulation::inputs() const noexcept { return engine_->inputs(); }
void Simulation::set_input(std::string_view name, double value) {
  engine_->require_idle("set_input");
  engine_->set_input(place_of(model().inputs, "input", name), value);
}
void Simulation::set_input(std::ptrdiff_t index, double value) {
  engine_->require_idle("set_input");
  engine_->set_input(place_of(model().inputs, "input", index), value);
}

std::vector<std::string> Simulation::output_names() const { return names_of(model().outputs); }
std::span<const double> Simulation::outputs() const noexcept { return engine_->outputs(); }
double Simulation::output(std::string_view name) const {
  return outputs()[place_of(model().outputs, "output", name)];
}
double Simulation::output(std::ptrdiff_t index) const {
  return outputs()[place_of(model().outputs, "output", index)];
}

void Simulation::on_force(ForceCallback callback) { engine_->on_force(std::move(callback)); }
SimulationState Simulation::save() const { return engine_->save(); }
void Simulation::restore(const SimulationState& state) { engine_->restore(state); }
void Simulation::change_model(const Model& changed) {
  engine_->require_idle("change_model");
  if (engine_->steps_as(built(changed))) return;
  engine_ = std::make_unique<Engine>(changed, *engine_);
  engine_->begin_observation(StepsBegin::changed);
}

}  // namespace floatframe
