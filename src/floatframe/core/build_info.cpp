#include "floatframe/core/build_info.hpp"

#include <Eigen/Core>
#include <fstream>

#include "floatframe/core/version.hpp"

namespace floatframe {

// A program compiled for the baseline shares objects with the library compiled for AVX2: the layout
// of fixed-size matrices must not depend on the instruction set. Eigen's own choice of alignment
// does. Windows has the runtime of FMUs alone, compiled once, whose stack is aligned to 16 bytes.
#ifndef _WIN32
static_assert(alignof(Eigen::Vector4d) == 32 && alignof(Eigen::Matrix<double, 6, 6>) == 32);
static_assert(EIGEN_MALLOC_ALREADY_ALIGNED == 0);
#endif

std::string version() { return FLOATFRAME_VERSION; }

std::string instruction_set() {
#if defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__)
  return "x86-64-v3";
#elif defined(__x86_64__)
  return "x86-64";
#else
  return "generic";
#endif
}

std::string build_description() {
  std::string text = version() + ", " + FLOATFRAME_BUILD_TYPE + ", " + FLOATFRAME_COMPILER + ", " +
                     instruction_set();
  const std::string sanitizers = FLOATFRAME_SANITIZERS;
  if (!sanitizers.empty()) text += ", sanitizers " + sanitizers;
  return text;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (line.find(':') != std::string::npos && start != std::string::npos)
      return line.substr(start);
  }
  return "unknown processor";
}

}  // namespace floatframe
