#pragma once
// The processor time of the calling thread: it does not advance while the host runs other work.
#include <time.h>

#include <cstdint>

namespace floatframe {

using Nanoseconds = std::int64_t;

inline Nanoseconds nanoseconds(const timespec& t) noexcept {
  return static_cast<Nanoseconds>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

inline Nanoseconds thread_cpu_clock() noexcept {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return nanoseconds(t);
}

/// The same in seconds.
inline double thread_seconds() noexcept { return 1e-9 * static_cast<double>(thread_cpu_clock()); }

}  // namespace floatframe
