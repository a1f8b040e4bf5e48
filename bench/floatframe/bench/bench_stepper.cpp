#include "floatframe/bench/bench_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/core/thread_clock.hpp"

namespace floatframe {

BenchStepper::BenchStepper(const Model& model, const SimulationDescription& options)
    : steps_(model, options) {
  work_ = VecX::Zero(steps_.formulation().velocities());
}

void BenchStepper::jump_inputs() {
  jumps_ = true;
  for (const Input& input : steps_.model().inputs) {
    const double range = input.high - input.low;
    inputs_.push_back(input.initial);
    jumped_.push_back(input.initial + (std::isfinite(range) ? 0.01 * range : 1.0));
  }
}

bool BenchStepper::advance(long steps) noexcept {
  for (long k = 0; k < steps; ++k) {
    if (jumps_) {
      inputs_.swap(jumped_);
      steps_.formulation().set_inputs(inputs_);
    }
    if (!steps_.advance()) return false;
  }
  return true;
}

void BenchStepper::iterate(long iterations) noexcept {
  Formulation& f = steps_.formulation();
  const State& state = steps_.state();
  const double h = steps_.grid().step(), s = 0.25 * h * h;
  const double penalty = steps_.step_options().penalty_mass;
  for (long k = 0; k < iterations; ++k) {
    dynamics_at(f, state);
    f.residual(state.a, state.lambda, penalty / s, work_);
    f.factorize(1.0, 0.5 * h, s, penalty / s);
    f.solve(work_);
  }
}

VecX BenchStepper::sample() {
  VecX row(static_cast<Eigen::Index>(steps_.model().outputs.size()) + 1);
  steps_.sample(row.data());
  return row;
}

double time_iteration(BenchStepper& stepper, double seconds) {
  double least = std::numeric_limits<double>::infinity(), spent = 0.0;
  long repetitions = 1;
  for (int block = 0; block < 3 || spent < seconds; ++block) {
    const double before = thread_seconds();
    stepper.iterate(repetitions);
    const double time = thread_seconds() - before;
    spent += time;
    least = std::min(least, time / static_cast<double>(repetitions));
    // Blocks of about 0.3 ms: long compared with the resolution of the clock, short compared with
    // the time between disturbances.
    repetitions = std::clamp(static_cast<long>(3e-4 / std::max(least, 1e-9)), 1L, 1000L);
  }
  return least;
}

}  // namespace floatframe
