#pragma once
// Steps a model in blocks for timing: the same steps as in a run, without recording between them.
#include <memory>
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/simulation/energies.hpp"
#include "floatframe/simulation/step_report.hpp"

namespace floatframe {

/// One combination of coordinates and inertia method.
class BenchStepper {
 public:
  virtual ~BenchStepper() = default;

  /// Returns to the start of the run.
  virtual void restart() = 0;
  /// From now on all inputs jump before each step, alternately by plus and minus a hundredth of
  /// their range (by one without a range).
  virtual void jump_inputs() = 0;
  /// Makes steps of the size given in the options. Returns false if one did not converge; the
  /// stepper cannot continue then.
  virtual bool advance(long steps) noexcept = 0;
  /// Full Newton iterations at the present state, which does not change: kinematics, inertia terms,
  /// forces, residual, factorisation, solution.
  virtual void iterate(long iterations) noexcept = 0;
  /// Since the start or the last `restart`.
  virtual StepCounters counts() const noexcept = 0;
  /// Number of velocities of the formulation.
  virtual int freedoms() const noexcept = 0;
  /// Time and the outputs of the model in their order.
  virtual VecX sample() = 0;
  virtual Energies energies() = 0;
  /// The reason why the last `advance` failed, as a sentence.
  virtual std::string failure() = 0;
};

/// Finds the start of the run. The model must outlive the stepper. Throws InputError, RunError.
std::unique_ptr<BenchStepper> make_bench_stepper(const Model& model,
                                                 const SimulationDescription& options);

/// Least time of one full Newton iteration [s of processor time], measured for about `seconds`.
double time_iteration(BenchStepper& stepper, double seconds);

}  // namespace floatframe
