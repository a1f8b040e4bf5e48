#include "floatframe/sweep/process_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace floatframe {
namespace {

/// Text of /proc/<process>/status; empty if it cannot be read. At most one page.
struct Status {
  char text[4096] = {};
  explicit Status(const char* path) {
    const int file = ::open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const ssize_t n = ::read(file, text, sizeof text - 1);
    text[n > 0 ? n : 0] = '\0';
    ::close(file);
  }
  /// Value of a line "VmRSS:     1234 kB".
  double megabytes(const char* name) const {
    const char* const line = std::strstr(text, name);
    return line ? 1.024e-3 * std::strtod(line + std::strlen(name), nullptr) : 0.0;
  }
};

}  // namespace

double memory_of(int process) {
  char path[40];
  std::snprintf(path, sizeof path, "/proc/%d/status", process);
  const Status status(path);
  return status.megabytes("\nVmRSS:") + status.megabytes("\nVmSwap:");
}

double peak_memory() { return Status("/proc/self/status").megabytes("\nVmHWM:"); }

bool forget_peak_memory() {
  const int file = ::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::write(file, "5", 1) == 1;
  ::close(file);
  return done;
}

}  // namespace floatframe
