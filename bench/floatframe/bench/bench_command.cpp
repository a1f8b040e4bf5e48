// floatframe bench: functions shared by the benchmarks.
#include "floatframe/bench/bench_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

namespace fs = std::filesystem;

std::string find_iltis() {
  const fs::path file = fs::path("examples") / "iltis" / "iltis.yaml";
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> places{file};
  if (!error) {
    const fs::path above = program.parent_path().parent_path();
    places = {above / file, file, above / "share" / "floatframe" / file};
  }
  std::string tried;
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place, error)) return place.string();
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  throw InputError(ErrorCode::unavailable,
                   fmt::format("the Iltis model was not found ({}); give it with --model", tried));
}

double number_within(const std::string& option, const std::string& text, double low, double high) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool complete = end != text.c_str() && *end == '\0';
  if (!complete || !std::isfinite(value) || !(value > low) || value > high) {
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("{}: found '{}', expected a number above {:g} and up to {:g}",
                                 option, text, low, high));
  }
  return value;
}

Command bench_command() {
  return {.name = "bench",
          .help = "Measure processor times on this machine",
          .commands = {bench_iltis_command(), bench_chain_command(), bench_scaling_command(),
                       bench_start_command(), bench_step_command()}};
}

}  // namespace floatframe
