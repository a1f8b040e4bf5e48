#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGXCPU end a run between two steps, with its files, its summary and
// its report.
#include <array>
#include <atomic>
#include <csignal>

namespace floatframe {

/// While it exists, the first signal requests the end and a second one terminates the program; the
/// processor time limit (SIGXCPU), which the system repeats every second, never terminates it.
/// SIGHUP stays ignored if it was (nohup).
class StopSignal {
 public:
  /// `flags`: additional sigaction flags (SA_RESTART).
  explicit StopSignal(int flags = 0);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Set once a signal has arrived.
  static const std::atomic<bool>& flag() noexcept;
  /// Its number; 0: none.
  static int number() noexcept;

 private:
  static constexpr std::array<int, 4> signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU};
  std::array<struct sigaction, signals.size()> before_{};
};

}  // namespace floatframe
