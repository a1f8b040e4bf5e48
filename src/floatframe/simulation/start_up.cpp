#include "floatframe/simulation/start_up.hpp"

#include <type_traits>

#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/system_state.hpp"

namespace floatframe {

template <class F>
StartedModel<F>::StartedModel(const Model& given, const SimulationDescription& o)
    : given_(given),
      changed_(started_model(given, o)),
      f_(model(), o.inertia),
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
}

template class StartedModel<RelativeFormulation>;
template class StartedModel<AbsoluteFormulation>;

}  // namespace floatframe
