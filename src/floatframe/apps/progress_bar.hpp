#pragma once
// Progress of a long command on a terminal (standard error): a bar, the percentage done and the
// estimated time to go, in one line; nothing where standard error is a file or a pipe.
#include <chrono>
#include <string>

#include "floatframe/core/work_progress.hpp"

namespace floatframe {

class ProgressBar {
 public:
  /// `total`: amount of work in `unit`, for instance 8 with unit "s".
  ProgressBar(bool enabled, double total, std::string unit);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(double fraction);
  /// With a text, which may be empty, in place of "3 of 8 s". `before`: the fraction done at the
  /// start, which is excluded from the estimate of the remaining time.
  void show(double fraction, const std::string& text, double before = 0.0);
  /// The work that follows is another one: its time begins now.
  void restart();
  /// Clears the line, so that the next text printed starts at its beginning.
  void clear();

 private:
  bool active_, drawn_ = false;
  double total_;
  std::string unit_;
  std::chrono::steady_clock::time_point start_;
};

/// For ListenToProgress: a bar for work that takes longer than a second.
ProgressListener progress_on_terminal(bool enabled);

}  // namespace floatframe
