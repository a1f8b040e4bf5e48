#include "floatframe/history/recorded_motion.hpp"

#include <algorithm>
#include <optional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

namespace {

[[noreturn]] void refuse_other_model(const StateHistory& history) {
  throw InputError(ErrorCode::mismatch, SourceMark{history.name(), 0, 0},
                   "its states are not of this model");
}

}  // namespace

struct RecordedMotion::Replay {
  Replay(const StateHistory& h, const Model& model, const SimulationDescription& options)
      : history(h),
        steps(model, options, {.duration = options.duration}),
        memory(steps.memory()),
        row(history.header().columns),
        computes_energies(needs_of_outputs(model).energies) {
    const Formulation& f = steps.formulation();
    if (h.header().configurations != f.configurations() ||
        h.header().velocities != f.velocities() || size_of("inputs") != f.inputs().size() ||
        size_of("spring_angles") != f.spring_angles().size() ||
        size_of("element_states") != static_cast<std::size_t>(f.element_states().count()))
      refuse_other_model(history);
    // Branches held are not recorded: laws are evaluated on those of the recorded positions.
    std::ranges::fill(memory.force_branches, free_branch);
    // A step starts from the integrator's `a`; if it was not recorded, it is solved for.
    if (!h.header().find("accelerations"))
      solver.emplace(f.coordinates(), steps.model(), options.inertia, memory.state,
                     ReactionOptions{steps.step_options().penalty_mass, steps.grid().step(),
                                     !steps.start_report().redundant.empty()});
  }

  const SystemMotion& at(std::size_t k, std::vector<double>& outputs) {
    restore(k, true);
    steps.sample(outputs.data());
    memory.outputs = steps.memory().outputs;  // turns counted by outputs
    return steps.formulation().motion({.accelerations = true, .energies = computes_energies});
  }

  const SystemMotion& without_outputs(std::size_t k, bool accelerations) {
    restore(k, accelerations);
    Formulation& f = steps.formulation();
    kinematics_at(f, memory.state);
    f.forces();
    if (accelerations) f.set_accelerations(memory.state.a);
    return f.motion({.accelerations = accelerations});
  }

  void restore(std::size_t k, bool accelerations) {
    history.instant(k, row);
    const HistoryHeader& h = history.header();
    State& s = memory.state;
    s.t = row[0];
    fill("q", h.q, s.q);
    fill("v", h.v, s.v);
    const std::span<const double> angles = group("spring_angles");
    memory.spring_angles.assign(angles.begin(), angles.end());
    const std::span<const double> states = group("element_states");
    s.z = VecX::Map(states.data(), std::ssize(states));
    Formulation& f = steps.formulation();
    f.set_inputs(group("inputs"));
    if (!solver) {
      fill("accelerations", h.v, s.a);
    } else if (accelerations) {
      s.a.setZero();
      solver->solve(s, f.inputs(), memory.spring_angles);
      s.a = solver->accelerations();
    }
    steps.set_memory(memory);
  }

  std::size_t size_of(const char* name) const {
    const HistoryGroup* g = history.header().find(name);
    return g ? g->count : 0;
  }
  std::span<const double> group(const char* name) const {
    const HistoryGroup* g = history.header().find(name);
    return g ? std::span<const double>(row).subspan(g->first, g->count) : std::span<const double>();
  }
  void fill(const char* name, const std::vector<int>& places, VecX& x) const {
    const std::span<const double> numbers = group(name);
    for (std::size_t i = 0; i < places.size(); ++i) x[places[i]] = numbers[i];
  }

  const StateHistory& history;
  Stepper steps;
  StepperMemory memory;
  std::optional<ReactionSolver> solver;
  std::vector<double> row;
  bool computes_energies;
};

RecordedMotion::RecordedMotion(const StateHistory& history, const Model& model,
                               const SimulationDescription& options)
    : history_(history), outputs_(model.outputs.size() + 1) {
  require_valid_run(options);
  if (history.header().bodies.size() != model.bodies.size()) refuse_other_model(history);
  replay_ = std::make_unique<Replay>(history, model, options);
}

RecordedMotion::~RecordedMotion() = default;

const SystemMotion& RecordedMotion::at(std::size_t k) { return replay_->at(k, outputs_); }

const SystemMotion& RecordedMotion::without_outputs(std::size_t k, bool accelerations) {
  return replay_->without_outputs(k, accelerations);
}

}  // namespace floatframe
