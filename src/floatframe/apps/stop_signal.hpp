#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGXCPU end a run between two steps: with its files, its summary and
// its report.
#include <array>
#include <atomic>
#include <csignal>

namespace floatframe {

/// While it is there the first signal asks for the end, a second one ends the program; but the
/// limit of processor time, which the system repeats every second, only asks. SIGHUP stays ignored
/// where it was (nohup).
class StopSignal {
 public:
  /// `flags` beside those above, as of sigaction: SA_RESTART.
  explicit StopSignal(int flags = 0);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// True once a signal has come.
  static const std::atomic<bool>& asked() noexcept;
  /// Its number; 0: none.
  static int number() noexcept;

 private:
  static constexpr std::array<int, 4> signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU};
  std::array<struct sigaction, signals.size()> before_{};
};

}  // namespace floatframe
