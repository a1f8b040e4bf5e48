#include "floatframe/simulation/start_up.hpp"

#include <type_traits>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/system_state.hpp"

namespace floatframe {

template <class F>
StartedModel<F>::StartedModel(const Model& given, const SimulationDescription& o)
    : given_(built(given)),
      changed_(started_model(given, o)),
      inertia_(o.inertia),
      f_(model(), inertia_),
      step_options_(floatframe::step_options(model(), o)),
      min_step_(o.min_step > 0.0 ? o.min_step : o.step / 1024.0) {
  if constexpr (std::is_same_v<F, RelativeFormulation>) {
    state_ = start_state(f_, o, &report_);
  } else {
    RelativeFormulation tree(model(), o.inertia);
    const State start = start_state(tree, o, &report_);
    state_.t = start.t;
    f_.start_from(tree, start.q, start.v, state_.q, state_.v);
  }
  start_accelerations(f_, state_, step_options_.penalty_mass);
  spring_angles_.assign(f_.spring_angles().begin(), f_.spring_angles().end());
}

template <class F>
StartedModel<F>::StartedModel(const StartedModel& found)
    : given_(found.model()),
      inertia_(found.inertia_),
      f_(model(), inertia_),
      state_(found.state_),
      spring_angles_(found.spring_angles_),
      report_(found.report_),
      step_options_(found.step_options_),
      min_step_(found.min_step_) {
  f_.set_spring_angles(spring_angles_);
}

template class StartedModel<RelativeFormulation>;
template class StartedModel<AbsoluteFormulation>;

}  // namespace floatframe
