#pragma once
// Options of a paced run.
#include <atomic>

#include "floatframe/description/description.hpp"

namespace floatframe {

class SignalLog;

/// Reaction to inputs missing for `RealTimeOptions::input_timeout`.
enum class SilenceFallback {
  hold,     ///< keep the last values
  initial,  ///< use the initial values until inputs return
  stop      ///< the run fails; only after inputs were received once
};

struct RealTimeOptions {
  bool paced = true;     ///< false: as fast as possible
  bool endless = false;  ///< run until `stop`, not for the duration of the description
  /// > 0: fixed number of Newton iterations per step, accepted whatever their error. 0: to
  /// convergence, with the step divided if necessary, down to an eighth.
  int fixed_iterations = 0;
  double time_budget = 0.0;  ///< > 0: no Newton iteration begins later in a step [s of wall clock]
  double max_lag = 0.1;      ///< [s]; 0: never catch up
  /// After this time without inputs a warning is printed and `fallback` applies [s of model time];
  /// 0: never.
  double input_timeout = 1.0;
  SilenceFallback fallback = SilenceFallback::hold;
  int priority = 0;  ///< 1 to 99: SCHED_FIFO
  bool lock_memory = false;
  bool strict = false;  ///< RunError if priority or locked memory is not granted
  const std::atomic<bool>* stop = nullptr;  ///< ends the run after the current step
  std::atomic<double>* progress = nullptr;  ///< model time [s], for other threads
  /// Model time since which inputs are missing [s], negative while they arrive; for other threads.
  /// Keeps its value when the run ends.
  std::atomic<double>* silent_since = nullptr;
  bool watch = true;         ///< report range warnings of the method, except for energies
  SignalLog* log = nullptr;  ///< records inputs and outputs of every step
};

/// Throws InputError with all errors of the options, or of the step and the duration for a run with
/// these options.
void require_valid(const RealTimeOptions& options, const SimulationDescription& simulation);

}  // namespace floatframe
