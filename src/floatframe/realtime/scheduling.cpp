#include "floatframe/realtime/scheduling.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace floatframe {
namespace {

/// Maps the stack pages used by the steps now instead of in the first step.
void touch_stack() noexcept {
  volatile char stack[256 * 1024];
  for (std::size_t i = 0; i < sizeof stack; i += 1024) stack[i] = 0;
  (void)stack[0];
}

}  // namespace

double stolen_time() {
  std::ifstream file("/proc/stat");
  std::string word;
  double user = 0, nice = 0, system = 0, idle = 0, wait = 0, irq = 0, soft_irq = 0, steal = 0;
  file >> word >> user >> nice >> system >> idle >> wait >> irq >> soft_irq >> steal;
  const long ticks = sysconf(_SC_CLK_TCK);
  return file && word == "cpu" && ticks > 0 ? steal / static_cast<double>(ticks) : 0.0;
}

RealTimeScheduling::RealTimeScheduling(const SchedulingRequest& request) {
  slack_before_ = prctl(PR_GET_TIMERSLACK, 0, 0, 0, 0);
  prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0);
  if (request.lock_memory) {
    locked_ = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    if (!locked_)
      refusals_.push_back(
          fmt::format("memory cannot be locked ({}): it needs CAP_IPC_LOCK or a higher limit of "
                      "locked memory (ulimit -l)",
                      std::strerror(errno)));
  }
  touch_stack();
  if (request.priority > 0) {
    sched_param before{};
    pthread_getschedparam(pthread_self(), &policy_before_, &before);
    priority_before_ = before.sched_priority;
    sched_param wanted{};
    wanted.sched_priority = request.priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
    priority_set_ = error == 0;
    if (!priority_set_)
      refusals_.push_back(
          fmt::format("priority {} is not granted ({}): it needs CAP_SYS_NICE or a limit of "
                      "real-time priority (ulimit -r)",
                      request.priority, std::strerror(error)));
  }
}

RealTimeScheduling::~RealTimeScheduling() {
  if (priority_set_) {
    sched_param before{};
    before.sched_priority = priority_before_;
    pthread_setschedparam(pthread_self(), policy_before_, &before);
  }
  if (locked_) munlockall();
  if (slack_before_ > 0) prctl(PR_SET_TIMERSLACK, slack_before_, 0, 0, 0);
}

}  // namespace floatframe
