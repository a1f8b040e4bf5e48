#pragma once
// Shows what a paced run is doing while it runs, from a thread of its own: the stepping thread only
// writes two numbers.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "floatframe/realtime/realtime.hpp"

namespace floatframe {

class RealTimeProgress {
 public:
  /// `duration` [s] of which a bar shows the progress; 0: no bar. `silences`: inputs that stay
  /// away, and that come again, are reported on standard error.
  RealTimeProgress(double duration, bool silences, SilenceFallback fallback);
  ~RealTimeProgress();
  RealTimeProgress(const RealTimeProgress&) = delete;
  RealTimeProgress& operator=(const RealTimeProgress&) = delete;

  std::atomic<double> time{0.0};           ///< RealTimeOptions::progress
  std::atomic<double> silent_since{-1.0};  ///< RealTimeOptions::silent_since

 private:
  void loop(double duration);
  /// One line when a silence begins or ends.
  void report_silence();

  bool silences_;
  SilenceFallback fallback_;
  double shown_ = -1.0;  ///< the beginning of the silence that has been reported
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace floatframe
