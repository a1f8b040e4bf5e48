#pragma once
// Steps a model in blocks for timing: the same steps as in a run, without recording between them.
#include <string>
#include <vector>

#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

/// One combination of coordinates and inertia method.
class BenchStepper {
 public:
  /// Finds the start of the run. The model must outlive the stepper. Throws InputError, RunError.
  BenchStepper(const Model& model, const SimulationDescription& options);

  /// Returns to the start of the run.
  void restart() { steps_.restart(); }
  /// From now on all inputs jump before each step, alternately by plus and minus a hundredth of
  /// their range (by one without a range).
  void jump_inputs();
  /// Makes steps of the size given in the options. Returns false if one did not converge; the
  /// stepper cannot continue then.
  bool advance(long steps) noexcept;
  /// Full Newton iterations at the present state, which does not change: kinematics, inertia terms,
  /// forces, residual, factorisation, solution.
  void iterate(long iterations) noexcept;
  /// Since the start or the last `restart`.
  StepCounters counts() const noexcept { return steps_.counters(); }
  /// Number of velocities of the formulation.
  int freedoms() const noexcept { return steps_.formulation().velocities(); }
  /// Time and the outputs of the model in their order.
  VecX sample();
  Energies energies() { return steps_.energies(); }
  /// The reason why the last `advance` failed, as a sentence.
  std::string failure() { return steps_.failure(); }

 private:
  Stepper steps_;
  VecX work_;
  bool jumps_ = false;
  std::vector<double> inputs_, jumped_;
};

/// Least time of one full Newton iteration [s of processor time], measured for about `seconds`.
double time_iteration(BenchStepper& stepper, double seconds);

}  // namespace floatframe
