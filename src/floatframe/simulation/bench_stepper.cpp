#include "floatframe/simulation/bench_stepper.hpp"

#include <algorithm>
#include <ctime>
#include <limits>
#include <optional>
#include <vector>

#include "floatframe/simulation/runner.hpp"
#include "floatframe/simulation/start_up.hpp"

namespace floatframe {
namespace {

template <class F>
class Stepper final : public BenchStepper {
 public:
  Stepper(const Model& model, const SimulationDescription& options)
      : o_(options), start_(model, options), f_(start_.formulation()) {
    angles_.assign(f_.spring_angles().begin(), f_.spring_angles().end());
    restart();
  }

  void restart() override {
    runner_.emplace(f_, start_.step_options(), start_.min_step());
    runner_->state() = start_.state();
    f_.set_spring_angles(angles_);
    work_ = VecX::Zero(f_.velocities());
    steps_ = 0;
  }

  bool advance(long steps) noexcept override {
    for (long k = 0; k < steps; ++k) {
      if (!runner_->advance(o_.step)) return false;
      ++steps_;
      runner_->state().t = time();
    }
    return true;
  }

  void iterate(long iterations) noexcept override {
    const State& state = runner_->state();
    const double s = 0.25 * o_.step * o_.step, penalty = start_.step_options().penalty_mass;
    for (long k = 0; k < iterations; ++k) {
      f_.positions(state.t, state.q);
      f_.velocities(state.v);
      f_.dynamics();
      f_.residual(state.a, state.lambda, penalty / s, work_);
      f_.factorize(1.0, 0.5 * o_.step, s, penalty / s);
      f_.solve(work_);
    }
  }

  StepCounts counts() const noexcept override {
    return {steps_, runner_->iterations(), runner_->factorizations(), runner_->substeps()};
  }

  int freedoms() const noexcept override { return f_.velocities(); }

  double time() const noexcept override {
    return start_.state().t + static_cast<double>(steps_) * o_.step;
  }

  VecX sample() override {
    VecX row(static_cast<Eigen::Index>(start_.model().outputs.size()) + 1);
    runner_->sample(row.data());
    return row;
  }

  Energies energies() override {
    Energies e;
    e.potential = runner_->potential_energy();  // brings the formulation to the present state
    e.elastic = runner_->elastic_energy();
    e.kinetic = runner_->kinetic_energy();
    return e;
  }

  std::string failure() const override { return runner_->failure(); }

 private:
  const SimulationDescription o_;
  StartedModel<F> start_;
  F& f_;
  std::vector<double> angles_;  ///< of springs at the start: the turns they count from
  VecX work_;
  std::optional<Runner<F>> runner_;
  long steps_ = 0;
};

}  // namespace

std::unique_ptr<BenchStepper> make_bench_stepper(const Model& model,
                                                 const SimulationDescription& options) {
  if (options.coordinates == Coordinates::relative)
    return std::make_unique<Stepper<RelativeFormulation>>(model, options);
  return std::make_unique<Stepper<AbsoluteFormulation>>(model, options);
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
    // Blocks of about 0.3 ms: long against the resolution of the clock, short against the time
    // between disturbances.
    repetitions = std::clamp(static_cast<long>(3e-4 / std::max(least, 1e-9)), 1L, 1000L);
  }
  return least;
}

double thread_seconds() noexcept {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace floatframe
