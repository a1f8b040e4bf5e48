#include "floatframe/core/memory_room.hpp"

#include <fmt/format.h>
#ifndef _WIN32
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <fstream>
#include <limits>

namespace floatframe {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

#ifndef _WIN32
/// The first number of a file, or of the line of it that begins with `key`.
double number_in(const char* file, const std::string& key = "") {
  std::ifstream in(file);
  std::string word;
  while (!key.empty() && in >> word)
    if (word == key) break;
  double number = 0.0;
  return in >> number ? number : infinite;
}
#endif

}  // namespace

#ifdef _WIN32
// Unknown: only the runtime of FMUs is there, which has no large results.
double memory_room() { return infinite; }
#else
double memory_room() {
  double room = 1024.0 * number_in("/proc/meminfo", "MemAvailable:");
  const double of_group = number_in("/sys/fs/cgroup/memory.max");
  if (of_group < infinite)
    room = std::min(room, of_group - number_in("/sys/fs/cgroup/memory.current"));
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const double used =
        number_in("/proc/self/statm") * static_cast<double>(::sysconf(_SC_PAGESIZE));
    if (used < infinite) room = std::min(room, static_cast<double>(limit.rlim_cur) - used);
  }
  return std::max(room, 0.0);
}
#endif

std::string memory_complaint(double bytes) {
  constexpr double giga = 1e9;
  if (bytes < 0.1 * giga) return "";
  const double room = memory_room();
  if (bytes <= room) return "";
  return fmt::format("takes about {:.2g} GB of memory, of which {:.2g} GB are free", bytes / giga,
                     room / giga);
}

}  // namespace floatframe
