#include "floatframe/simulation/iteration_timer.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "floatframe/simulation/start_up.hpp"

namespace floatframe {

double relative_iteration_seconds(const Model& model, const SimulationDescription& options) {
  StartedModel<RelativeFormulation> start(model, options);
  RelativeFormulation& f = start.formulation();
  const State& state = start.state();
  const double penalty_mass = start.step_options().penalty_mass;
  const double s = 0.25 * options.step * options.step;
  VecX r(f.velocities());
  double best = std::numeric_limits<double>::infinity();
  using Clock = std::chrono::steady_clock;
  for (int block = 0; block < 200; ++block) {
    constexpr int repetitions = 20;
    const auto before = Clock::now();
    for (int k = 0; k < repetitions; ++k) {
      f.positions(state.t, state.q);
      f.velocities(state.v);
      f.dynamics();
      f.residual(state.a, state.lambda, penalty_mass / s, r);
      f.factorize(1.0, 0.5 * options.step, s, penalty_mass / s);
      f.solve(r);
    }
    best =
        std::min(best, std::chrono::duration<double>(Clock::now() - before).count() / repetitions);
  }
  return best;
}

}  // namespace floatframe
