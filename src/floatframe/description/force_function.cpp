#include "floatframe/description/force_function.hpp"

#include <fmt/format.h>

#include <atomic>
#include <random>

namespace floatframe {
namespace {

/// Differs between functions of a process, and between processes.
std::string unique_identity() {
  static const std::string process = [] {
    std::random_device random;
    return fmt::format("{:08x}{:08x}{:08x}", random(), random(), random());
  }();
  static std::atomic<long> count{0};
  return fmt::format("function {} of {}", ++count, process);
}

}  // namespace

ForceFunction::ForceFunction(Law law, std::string label, int)
    : law_(std::move(law)), identity_(label.empty() ? unique_identity() : std::move(label)) {}

}  // namespace floatframe
