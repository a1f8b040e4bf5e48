#pragma once
// A run with a sampled controller of a program.
#include <functional>
#include <span>

#include "floatframe/run/run.hpp"

namespace floatframe {

struct Controller {
  /// Called at the beginning of steps with the time, the outputs and the inputs, which it may
  /// change and which are held from then on, as by `Simulation::on_force`. Values are subject to
  /// the rules of `set_input` (InputError). Its exceptions come out of the run.
  std::function<void(double time, std::span<const double> outputs, std::span<double> inputs)>
      on_step;
  double period = 0.0;  ///< [s], a multiple of the step; 0: every step
};

/// As `run`; a controller that changes nothing leaves the same bits. Throws InputError for a run
/// with checkpoints, which do not hold what a program remembers.
RunResult run(const Model& model, const SimulationDescription& options,
              const RunOptions& run_options, const Controller& controller);

}  // namespace floatframe
