#pragma once
// A sampled controller of a run: between steps it is given the outputs and sets the inputs.
#include <span>
#include <vector>

#include "floatframe/run/controlled_run.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

class StepControl {
 public:
  /// Throws InputError unless the period is zero or a multiple of the step of the grid.
  StepControl(Stepper& steps, const Controller& controller);

  /// A row of the table was sampled at the present state: time and outputs.
  void sampled(const double* row) noexcept;
  /// Before the step that follows `made` steps. Throws what the function throws, and InputError for
  /// values that inputs cannot have.
  void before_step(long made);

 private:
  Stepper& steps_;
  const Controller& controller_;
  long every_;               ///< steps
  std::vector<double> row_;  ///< time and outputs
  bool current_ = false;     ///< `row_` is of the present state
  std::vector<double> wanted_;
};

}  // namespace floatframe
