#pragma once
// How the operating system treats the stepping thread, asked for while a `RealTimeScheduling` lives
// and put back at its end:
//   priority     SCHED_FIFO: nothing of normal priority runs on its processor while it computes
//   lock_memory  all pages of the process stay in memory, and its stack is touched beforehand
//   timer slack  1 ns instead of 50 us, so that a thread of normal priority wakes on time too
// What the system does not permit is said in `refusals`, and the run goes on without.
#include <string>
#include <vector>

namespace floatframe {

struct SchedulingRequest {
  int priority = 0;  ///< 1 to 99: SCHED_FIFO; 0: as it is
  bool lock_memory = false;
};

/// Time that the host has taken from all processors of this virtual machine since it started [s]; 0
/// if the system does not tell.
double stolen_time();

class RealTimeScheduling {
 public:
  explicit RealTimeScheduling(const SchedulingRequest& request);
  ~RealTimeScheduling();
  RealTimeScheduling(const RealTimeScheduling&) = delete;
  RealTimeScheduling& operator=(const RealTimeScheduling&) = delete;

  /// What was asked for and refused, a sentence each; empty if all was granted.
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
