#pragma once
// Shows the progress of a paced run from a separate thread: the stepping thread only writes two
// numbers.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "floatframe/realtime/realtime.hpp"

namespace floatframe {

class RealTimeProgress {
 public:
  /// `duration` [s] for the progress bar; 0: no bar. `silences`: the loss and return of inputs is
  /// reported on standard error.
  RealTimeProgress(double duration, bool silences, SilenceFallback fallback);
  ~RealTimeProgress();
  RealTimeProgress(const RealTimeProgress&) = delete;
  RealTimeProgress& operator=(const RealTimeProgress&) = delete;

  std::atomic<double> time{0.0};           ///< RealTimeOptions::progress
  std::atomic<double> silent_since{-1.0};  ///< RealTimeOptions::silent_since

 private:
  void loop(double duration);
  /// Prints one line when a silence begins or ends.
  void report_silence();

  bool silences_;
  SilenceFallback fallback_;
  double shown_ = -1.0;  ///< start of the silence already reported
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace floatframe
