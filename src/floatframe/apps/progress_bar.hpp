#pragma once
// Progress of a run on a terminal (standard error); nothing where standard error is a file or a
// pipe.
#include <chrono>
#include <string>

namespace floatframe {

class ProgressBar {
 public:
  /// `total`: amount of work in `unit`, for instance 8 with unit "s".
  ProgressBar(bool enabled, double total, std::string unit);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(double fraction);
  /// With a text in place of "3 of 8 s". `before`: the fraction done at the start, which is
  /// excluded from the estimate of the remaining time.
  void show(double fraction, const std::string& text, double before = 0.0);
  /// Clears the line, so that the next text printed starts at its beginning.
  void clear();

 private:
  bool active_, drawn_ = false;
  double total_;
  std::string unit_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace floatframe
