#pragma once
// Scheduling of the stepping thread by the operating system, set while a `RealTimeScheduling`
// exists and restored at its end:
//   priority     SCHED_FIFO: nothing of normal priority runs on its processor while it computes
//   lock_memory  all pages of the process stay in memory, and its stack is touched beforehand
//   timer slack  1 ns instead of 50 us, so that a thread of normal priority wakes on time too
// Settings not permitted by the system are listed in `refusals`; the run continues without.
#include <string>
#include <vector>

namespace floatframe {

struct SchedulingRequest {
  int priority = 0;  ///< 1 to 99: SCHED_FIFO; 0: unchanged
  bool lock_memory = false;
};

/// Time that the host has taken from all processors of this virtual machine since it started [s]; 0
/// if the system does not report it.
double stolen_time();

class RealTimeScheduling {
 public:
  explicit RealTimeScheduling(const SchedulingRequest& request);
  ~RealTimeScheduling();
  RealTimeScheduling(const RealTimeScheduling&) = delete;
  RealTimeScheduling& operator=(const RealTimeScheduling&) = delete;

  /// Settings that were not granted, one sentence each; empty if all were granted.
  const std::vector<std::string>& refusals() const noexcept { return refusals_; }
  bool has_priority() const noexcept { return priority_set_; }
  bool memory_locked() const noexcept { return locked_; }

 private:
  std::vector<std::string> refusals_;
  bool priority_set_ = false, locked_ = false;
  int policy_before_ = 0, priority_before_ = 0;
  int slack_before_ = 0;
};

}  // namespace floatframe
