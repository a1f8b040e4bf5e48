#pragma once
// The two clocks of a paced run, in nanoseconds: CLOCK_MONOTONIC, which is never set back, and the
// processor time of the calling thread. The latter does not advance while the host runs other work,
// so their difference over a step separates preemption from computation. (On a virtual machine time
// stolen by the hypervisor may count as processor time; only the host knows.)
#include <time.h>

#include "floatframe/core/thread_clock.hpp"

namespace floatframe {

inline Nanoseconds wall_clock() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return nanoseconds(t);
}

/// Sleeps until the wall clock shows `due`; false if a signal ended the sleep early.
inline bool sleep_until(Nanoseconds due) noexcept {
  timespec t{};
  t.tv_sec = static_cast<time_t>(due / 1'000'000'000);
  t.tv_nsec = static_cast<long>(due % 1'000'000'000);
  return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == 0;
}

}  // namespace floatframe
