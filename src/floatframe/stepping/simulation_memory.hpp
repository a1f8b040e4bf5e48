#pragma once
// The content of a SimulationState.
#include <cstdint>
#include <string>
#include <vector>

#include "floatframe/stepping/simulation_state.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

struct SimulationState::Data {
  /// Of the model, and of the options that determine the steps: a difference leads to other steps.
  std::string fingerprint;
  std::int64_t coordinates = 0, inertia = 0, max_iterations = 0, locate_edges = 0, input = 0;
  double step = 0.0, spectral_radius = 0.0, tolerance = 0.0, min_step = 0.0, penalty = 0.0;
  double position_tolerance = 0.0, velocity_tolerance = 0.0;

  StepperMemory steps;
  std::vector<double> inputs;
  std::vector<double> row;     ///< time and outputs
  std::vector<double> joints;  ///< coordinates, turns counted, and rates
  double joints_time = 0.0;
};

}  // namespace floatframe
