#include "floatframe/stepping/samples.hpp"

#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/reactions/reaction_solver.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {

Samples::Samples(const Model& model) {
  Eigen::Index place = 0;
  for (const Element& e : model.elements) {
    const std::size_t before = list_.size();
    for (const FormulaOperand& x : e.operands) {
      if (x.kind != FormulaOperand::Kind::sample) continue;
      list_.push_back({&x.output, place + e.states + x.index});
      needs_ = needs_ | needs_of(x.output);
    }
    if (list_.size() > before) elements_.push_back(e.name);
    place += e.states + e.kept;
  }
}

namespace {

bool nearly_equal(const VecX& a, const VecX& b) {
  constexpr double enough = 1e-10;
  return ((a - b).array().abs() <= enough * (1.0 + b.array().abs())).all();
}

}  // namespace

std::string settle_samples(InitialisedModel& started, double step) {
  const Samples samples(started.model());
  if (samples.empty()) return "";
  Formulation& f = started.formulation();
  const double penalty_mass = started.step_options().penalty_mass;
  std::optional<ReactionSolver> reactions;
  if (samples.needs().reactions)
    reactions.emplace(f.coordinates(), started.model(), started.inertia(), started.state(),
                      ReactionOptions{penalty_mass, step, !started.report().redundant.empty()});
  State state = started.state();
  const auto take = [&] {
    dynamics_at(f, state);
    if (reactions) reactions->solve(state, f.inputs(), f.spring_angles(), f.force_branches());
    f.set_accelerations(reactions ? reactions->accelerations() : state.a);
    samples.take(f.motion(samples.needs(), reactions ? &reactions->reactions() : nullptr), state.z);
    kinematics_at(f, state);
    f.start_element_states(StateStart::found);
    state.z = f.element_states().values();
  };
  take();
  State first = state;
  constexpr int most_rounds = 100;
  bool settled = false;
  for (int k = 0; k < most_rounds && !settled && state.z.allFinite(); ++k) {
    start_accelerations(f, state, penalty_mass);
    const VecX before = state.z;
    take();
    settled = nearly_equal(state.z, before);
  }
  State& out = settled ? state : first;
  dynamics_at(f, out);
  out.zd = out.zd_alg = f.element_states().rates();
  started.move_to(std::move(out));
  if (settled) return "";
  return named_text("controller", "controllers", samples.elements()) +
         ": accelerations, reactions or stresses of the start that are read there depend on "
         "themselves and do not settle; the start has the forces without them";
}

}  // namespace floatframe
