#pragma once
// Detects interruptions of the inputs. A silence has a beginning, the last step that received
// inputs, and an end; the first ones are recorded in the report.
#include <cmath>
#include <limits>

#include "floatframe/realtime/realtime.hpp"

namespace floatframe {

class InputWatch {
 public:
  /// `step` [s]. `listening`: there are inputs and a port that can receive them.
  InputWatch(const RealTimeOptions& options, double step, bool listening, RealTimeReport& report)
      : since_(options.silent_since),
        timeout_(listening && options.input_timeout > 0.0
                     ? std::max(1L, std::lround(std::min(options.input_timeout / step, 1e15)))
                     : std::numeric_limits<long>::max()),
        report_(report) {}

  /// Inputs were received for the step that begins at `time` [s].
  void received(double time) noexcept {
    if (silent_) end(time, true);
    without_ = 0;
    last_ = report_.last_inputs = time;
    report_.inputs_came = true;
  }

  /// No inputs were received for a step. True at the one with which the silence begins.
  bool missed() noexcept {
    if (++without_ != timeout_) return false;
    silent_ = true;
    ++report_.input_timeouts;
    if (since_ != nullptr) since_->store(last_, std::memory_order_relaxed);
    return true;
  }

  /// The run ends at `time` [s].
  void finish(double time) noexcept {
    if (silent_) end(time, false);
  }

 private:
  void end(double time, bool came_again) noexcept {
    const std::size_t k = report_.input_timeouts - 1;
    if (k < report_.silences.size()) report_.silences[k] = {last_, time, came_again};
    silent_ = false;
    // A silence that lasts to the end of the run is not ended.
    if (came_again && since_ != nullptr) since_->store(-1.0, std::memory_order_relaxed);
  }

  std::atomic<double>* since_;
  long timeout_, without_ = 0;
  double last_ = 0.0;
  bool silent_ = false;
  RealTimeReport& report_;
};

}  // namespace floatframe
