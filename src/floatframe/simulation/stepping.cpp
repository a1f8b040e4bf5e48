#include "floatframe/simulation/stepping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/simulation/light_motion.hpp"
#include "floatframe/simulation/start_up.hpp"
#include "floatframe/simulation/stepping_engine.hpp"
#include "floatframe/simulation/system_state.hpp"

namespace floatframe {

template <class F>
class Simulation::EngineOf final : public Simulation::Engine {
 public:
  EngineOf(const Model& given, const SimulationDescription& o)
      : Engine(given, o),
        start_(model(), options()),
        f_(start_.formulation()),
        runner_(f_, start_.step_options(), start_.min_step()),
        joints_(start_.model()) {
    runner_.state() = start_.state();
    base_ = start_.state().t;
    for (int k = 0; k < f_.velocities(); ++k) owners_.push_back(f_.coordinate_owner(k));
    for (int k = 0; k < f_.constraints(); ++k)
      owners_.push_back(f_.constraint_set().owner_of_row(k));
    for (const Force& force : model().forces) owners_.push_back("force '" + force.name + "'");
    runner_.sample(row_.data());
    joints_.follow_present(f_, base_);
  }

  const StartReport& start_report() const noexcept override { return start_.report(); }
  StepCounters counters() const noexcept override {
    StepCounters c = runner_.counters();
    c.steps = steps_;
    return c;
  }
  SystemState state() override {
    // By what was followed at the last step: it need not be followed again.
    JointFollower joints = joints_;
    SystemState s = system_state(f_, runner_.state(), joints);
    place_bodies(model(), options().inertia, s);
    return s;
  }

 protected:
  bool advance(double h, double to) noexcept override {
    // Of a step that failed the formulation is left as it is: it shows where to look.
    // A longer step is not divided into more parts than one of the options: its work is bounded.
    const double least = start_.min_step() * std::max(1.0, h / options().step);
    if (!runner_.advance(h, least)) return false;
    runner_.state().t = to;
    ++steps_;
    runner_.sample(row_.data());
    joints_.follow_present(f_, to);
    return true;
  }

  const StepAttempt& attempt() const noexcept override { return runner_.last(); }

  Place place() const noexcept override {
    Place p;
    p.time = runner_.state().t;
    const StepAttempt& a = runner_.last();
    p.status = a.status == AttemptStatus::singular_tangent ? StepStatus::singular_tangent
               : a.status == AttemptStatus::not_finite     ? StepStatus::not_finite
                                                           : StepStatus::not_converged;
    const int nv = f_.velocities(), nc = f_.constraints();
    if (a.constraint >= 0)
      p.owner = nv + a.constraint;
    else if (a.coordinate >= 0)
      p.owner = a.coordinate;
    else if (const int force = runner_.largest_force(); force >= 0)
      p.owner = nv + nc + force;
    return p;
  }

  std::string sentence() override {
    std::string text = runner_.failure();
    return text + light_motion_note(f_, runner_.state());  // moves f_
  }

  void inputs_to_formulation() noexcept override { f_.set_inputs(inputs_); }

  void collect(SimulationState::Data& out) const override {
    out.state = runner_.state();
    out.spring_angles.assign(f_.spring_angles().begin(), f_.spring_angles().end());
    out.memory = runner_.memory();
    out.memory.counters.steps = steps_;
    out.joints = joints_.numbers();
    out.joints_time = joints_.time();
  }

  void apply(const SimulationState::Data& data) override {
    runner_.state() = data.state;
    runner_.set_memory(data.memory);
    f_.set_spring_angles(data.spring_angles);
    steps_ = data.memory.counters.steps;
    joints_.restore(data.joints, data.joints_time);
  }

 private:
  StartedModel<F> start_;
  F& f_;
  Runner<F> runner_;
  JointFollower joints_;
  long steps_ = 0;
};

namespace {

SimulationDescription described(const Model& model, const SimulationOptions& options) {
  SimulationDescription d = model.simulation;
  const auto set = [&d](const char* key, auto& value, const auto& wanted) {
    if (!wanted) return;
    value = *wanted;
    d.given_by("", key);
  };
  set("step", d.step, options.step);
  set("coordinates", d.coordinates, options.coordinates);
  set("inertia", d.inertia, options.inertia);
  if (options.state) {
    d.state = options.state;
    d.start = Start::state;
  }
  set("start", d.start, options.start);
  set("tolerance", d.tolerance, options.tolerance);
  set("spectral_radius", d.spectral_radius, options.spectral_radius);
  set("max_iterations", d.max_iterations, options.max_iterations);
  set("min_step", d.min_step, options.min_step);
  set("penalty", d.penalty, options.penalty);
  set("position_tolerance", d.position_tolerance, options.position_tolerance);
  set("velocity_tolerance", d.velocity_tolerance, options.velocity_tolerance);
  require_valid(d);
  return d;
}

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
  throw InputError(
      fmt::format("unknown {} '{}'{}", kind, excerpt(name), did_you_mean(name, names_of(list))));
}

template <class Entity>
std::size_t place_of(const std::vector<Entity>& list, const char* kind, std::ptrdiff_t index) {
  const auto n = static_cast<std::ptrdiff_t>(list.size());
  if (index >= 0 && index < n) return index;
  if (n == 0)
    throw InputError(
        fmt::format("found index {} of an {}, but the model has no {}s", index, kind, kind));
  throw InputError(fmt::format("found index {} of an {}, expected 0 to {}", index, kind, n - 1));
}

}  // namespace

Simulation::Simulation(const Model& model, const SimulationOptions& options) {
  const SimulationDescription d = described(model, options);
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
