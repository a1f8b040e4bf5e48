#pragma once
// A model that runs in step with the wall clock: step k starts at k h after the start of the clock,
// takes the available inputs, computes the state at (k + 1) h and sends its outputs as soon as they
// are computed. So outputs are ahead of the clock by h minus the computation time, and a controller
// that answers within that time acts on the next step.
//
// Overruns. A step whose computation takes longer than h is an overrun: by the *program* if the
// processor time of the stepping thread exceeds h, by the *host* otherwise (other work ran on the
// processor). Delayed steps start at once, one after the other, until the model has caught up; if
// it is more than `max_lag` behind, the clock is moved instead (a *slip*): model time then lags
// behind the wall clock by the sum of all slips.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "floatframe/core/histogram.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/realtime/realtime_options.hpp"
#include "floatframe/realtime/signal_port.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

struct StepsOfWork {
  long steps = 0;
  double cpu_sum = 0.0, cpu_max = 0.0;  ///< processor time [s]
};

/// Inputs missing for longer than `input_timeout`.
struct Silence {
  double from = 0.0;   ///< model time of the step with the last inputs; 0: there were none [s]
  double to = 0.0;     ///< model time of the step with the next inputs, or of the end [s]
  bool ended = false;  ///< inputs returned
};

struct RealTimeReport : StepCounters {
  static constexpr std::size_t most_silences = 16;

  std::string model, coordinates, inertia;
  double step = 0.0;
  double time = 0.0;  ///< model time reached [s]
  double wall = 0.0;  ///< [s], start of the first step to end of the last one
  bool paced = true, priority = false, memory_locked = false;
  std::vector<std::string> refusals;  ///< priority or locked memory that was not granted
  std::string status = "completed";   ///< "completed", "stopped" or "failed"
  std::string message;                ///< reason of a failure: time, cause
  /// Range warnings (docs/range.md), available at the end.
  std::vector<RangeWarning> warnings;
  StartReport start;

  Histogram cpu;              ///< processor time of each step: inputs, integration, outputs
  Histogram elapsed;          ///< wall clock of the same
  Histogram wake;             ///< wake-up delay of a sleep after the due time, caused by the host
  double worst_cpu_at = 0.0;  ///< model time of the largest processor time [s]
  long worst_cpu_iterations = 0;  ///< Newton iterations of that step
  /// Steps by the number of their Newton iterations; the last entry counts all with more. Work
  /// grows with the iterations; a slow step with few iterations was slowed down by the machine.
  std::array<StepsOfWork, 24> by_iterations{};
  long program_overruns = 0, host_overruns = 0;
  long late_steps = 0;  ///< not finished when the next one was due
  long slips = 0;
  double slipped = 0.0;  ///< sum of all slips [s]
  double stolen = 0.0;   ///< from virtual processors, by their host [s]; 0 if unknown
  long preemptions = 0, page_faults = 0;  ///< of the stepping thread

  long input_timeouts = 0;                        ///< number of input timeouts
  std::array<Silence, most_silences> silences{};  ///< the first of them
  bool inputs_came = false;                       ///< inputs were received at least once
  double last_inputs = 0.0;             ///< model time of the step with the last inputs [s]
  std::vector<double> inputs, outputs;  ///< values at the end
  std::vector<long> refused_inputs;     ///< rejected values, by input
  std::vector<long> clamped_inputs;     ///< values replaced by a limit, by input
};

/// Runs until the duration is over, `stop` is set or a step fails (`status`). `port` may be null.
/// Throws InputError or RunError if the run cannot start.
RealTimeReport run_real_time(const Model& model, const SimulationDescription& description,
                             const RealTimeOptions& options, SignalPort* port);

}  // namespace floatframe
