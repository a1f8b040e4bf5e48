#pragma once
// What a paced run is asked for.
#include <atomic>

#include "floatframe/model/description.hpp"

namespace floatframe {

class SignalLog;

/// What happens when inputs have stayed away for `RealTimeOptions::input_timeout`.
enum class SilenceFallback {
  hold,     ///< the last values stay
  initial,  ///< the initial values return until inputs come again
  stop      ///< the run ends as failed; only after inputs have come once
};

struct RealTimeOptions {
  bool paced = true;     ///< false: as fast as possible
  bool endless = false;  ///< until `stop`; else for the duration of the simulation description
  /// > 0: so many Newton iterations per step, accepted whatever their error. 0: to convergence,
  /// with the step divided if need be, down to an eighth.
  int fixed_iterations = 0;
  double time_budget = 0.0;  ///< > 0: no Newton iteration begins later in a step [s of wall clock]
  double max_lag = 0.1;      ///< [s]; 0: never catch up
  /// Inputs that stay away for so long are reported, and `fallback` acts [s of model time]; 0:
  /// never.
  double input_timeout = 1.0;
  SilenceFallback fallback = SilenceFallback::hold;
  int priority = 0;  ///< 1 to 99: SCHED_FIFO
  bool lock_memory = false;
  bool strict = false;  ///< RunError if priority or locked memory is not granted
  const std::atomic<bool>* stop = nullptr;  ///< ends the run after the present step
  std::atomic<double>* progress = nullptr;  ///< model time [s], for another thread to look at
  /// Model time since when inputs have stayed away [s], negative while they come; likewise. It
  /// stays as it is when the run ends.
  std::atomic<double>* silent_since = nullptr;
  bool watch = true;         ///< say where the run leaves the range of the method, but for energies
  SignalLog* log = nullptr;  ///< takes inputs and outputs of every step
};

/// Throws InputError with all that is wrong with the options, or with the step and the duration for
/// a run with them.
void require_valid(const RealTimeOptions& options, const SimulationDescription& simulation);

}  // namespace floatframe
