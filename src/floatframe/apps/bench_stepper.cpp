#include "floatframe/apps/bench_stepper.hpp"

#include <ctime>
#include <optional>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/runner.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {
namespace {

template <class F>
class Stepper final : public BenchStepper {
 public:
  Stepper(const Model& model, const SimulationDescription& options)
      : model_(model), o_(options), step_options_(floatframe::step_options(model, options)) {
    RelativeFormulation tree(model_, o_.inertia);
    const State start = relative_start(tree, o_.start);
    begin();
    if constexpr (std::is_same_v<F, RelativeFormulation>) {
      start_ = start;
    } else {
      f_->start_from(tree, start.q, start.v, start_.q, start_.v);
    }
    start_accelerations(*f_, start_, step_options_.penalty_mass);
    runner_->state() = start_;
  }

  void restart() override {
    begin();
    runner_->state() = start_;
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

  StepCounts counts() const noexcept override {
    return {steps_, runner_->iterations(), runner_->factorizations(), runner_->substeps()};
  }

  int freedoms() const noexcept override { return f_->velocities(); }

  double time() const noexcept override { return static_cast<double>(steps_) * o_.step; }

  VecX sample() override {
    VecX row(static_cast<Eigen::Index>(model_.outputs.size()) + 1);
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
  void begin() {
    runner_.reset();
    f_.emplace(model_, o_.inertia);
    runner_.emplace(*f_, step_options_, o_.min_step > 0.0 ? o_.min_step : o_.step / 1024.0);
  }

  const Model& model_;
  const SimulationDescription o_;
  const StepOptions step_options_;
  State start_;
  std::optional<F> f_;
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

double thread_seconds() noexcept {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace floatframe
