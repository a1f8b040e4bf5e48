#include "floatframe/simulation/stepping.hpp"

#include <fmt/format.h>

#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/formulation/owners.hpp"
#include "floatframe/simulation/simulation_options.hpp"
#include "floatframe/simulation/stepped_model.hpp"
#include "floatframe/simulation/stepping_engine.hpp"

namespace floatframe {

template <class F>
class Simulation::EngineOf final : public Simulation::Engine {
 public:
  EngineOf(const Model& given, const SimulationDescription& o)
      : Engine(given, o), steps_(model(), options()), joints_(steps_.model()) {
    owners_ = coordinate_owners(steps_.formulation());
    for (std::string& owner : constraint_owners(steps_.formulation()))
      owners_.push_back(std::move(owner));
    for (const Element& force : model().elements) owners_.push_back("force '" + force.name + "'");
    sample();
  }

  const StartReport& start_report() const noexcept override { return steps_.start_report(); }
  StepCounters counters() const noexcept override { return steps_.counters(); }
  SystemState state() override {
    // Uses the data of the last step: it need not be tracked again.
    JointFollower joints = joints_;
    return steps_.system_state(joints);
  }

 protected:
  const TimeGrid& grid() const noexcept override { return steps_.grid(); }
  bool advance(const PlannedStep& step) noexcept override {
    // After a failed step the formulation remains at the failed iteration for diagnosis.
    if (!steps_.advance(step)) return false;
    sample();
    return true;
  }

  const StepAttempt& attempt() const noexcept override { return steps_.last(); }

  Place place() const noexcept override {
    Place p;
    p.time = steps_.state().t;
    const StepAttempt& a = steps_.last();
    p.status = a.status == AttemptStatus::singular_tangent ? StepStatus::singular_tangent
               : a.status == AttemptStatus::not_finite     ? StepStatus::not_finite
                                                           : StepStatus::not_converged;
    const F& f = steps_.formulation();
    const int nv = f.velocities(), nc = f.constraints();
    if (a.constraint >= 0)
      p.owner = nv + a.constraint;
    else if (a.coordinate >= 0)
      p.owner = a.coordinate;
    else if (const int force = steps_.largest_force(); force >= 0)
      p.owner = nv + nc + force;
    return p;
  }

  std::string sentence() override { return steps_.failure(); }

  void inputs_to_formulation() noexcept override { steps_.formulation().set_inputs(inputs_); }

  void collect(SimulationState::Data& out) const override {
    out.steps = steps_.memory();
    out.joints = joints_.numbers();
    out.joints_time = joints_.time();
  }

  void apply(const SimulationState::Data& data) override {
    steps_.set_memory(data.steps);
    joints_.restore(data.joints, data.joints_time);
  }

 private:
  void sample() noexcept {
    steps_.sample(row_.data());
    joints_.follow(steps_.formulation().motion());
  }

  SteppedModel<F> steps_;
  JointFollower joints_;
};

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
  const SimulationDescription d = described(built(model), options);
  if (d.coordinates == Coordinates::relative)
    engine_ = std::make_unique<EngineOf<RelativeFormulation>>(model, d);
  else
    engine_ = std::make_unique<EngineOf<AbsoluteFormulation>>(model, d);
}

Simulation::~Simulation() = default;

const Model& Simulation::model() const noexcept { return engine_->model(); }
const SimulationDescription& Simulation::options() const noexcept { return engine_->options(); }
const StartReport& Simulation::start_report() const noexcept { return engine_->start_report(); }
StepReport Simulation::step() noexcept { return engine_->step(); }
StepReport Simulation::step(double size) noexcept { return engine_->step(size); }
std::string Simulation::failure() const { return engine_->failure(); }
double Simulation::time() const noexcept { return engine_->time(); }
StepCounters Simulation::counters() const noexcept { return engine_->counters(); }
SystemState Simulation::state() const {
  engine_->require_idle("state");
  return engine_->state();
}

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

}  // namespace floatframe
