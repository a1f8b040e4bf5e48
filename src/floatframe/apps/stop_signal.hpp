#pragma once
// SIGINT and SIGTERM end a run between two steps: with its files, its summary and its report.
#include <atomic>
#include <csignal>

namespace floatframe {

/// While it is there the first signal asks for the end, a second one ends the program.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// True once a signal has come.
  static const std::atomic<bool>& asked() noexcept;
  /// Its number; 0: none.
  static int number() noexcept;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace floatframe
