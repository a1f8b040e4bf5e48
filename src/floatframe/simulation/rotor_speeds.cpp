#include "floatframe/simulation/rotor_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_speeds = 2000;
/// Above it squares of speeds leave the range in which eigenvalues can be found.
constexpr double most_speed = 1e9;

}  // namespace

std::vector<double> rotor_speeds(const std::string& joint, double from, double to, double step) {
  if (std::max(std::abs(from), std::abs(to)) > most_speed)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("speeds of '{}': found {:g} to {:g} rad/s, expected at most {:g}",
                                 joint, from, to, most_speed));
  if (!(step > 0.0) || !(to > from) || !std::isfinite(from) || !std::isfinite(to) ||
      !std::isfinite(step))
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("speeds of '{}': found {:g} to {:g} in steps of {:g} rad/s, "
                                 "expected an ascending range and a positive step",
                                 joint, from, to, step));
  if ((to - from) / step > static_cast<double>(most_speeds))
    throw InputError(
        ErrorCode::too_large,
        fmt::format("speeds of '{}': more than {} speeds; take a larger step", joint, most_speeds));
  std::vector<double> speeds;
  const auto n = static_cast<std::size_t>(std::floor((to - from) / step + 1e-9));
  for (std::size_t k = 0; k <= n; ++k) speeds.push_back(from + static_cast<double>(k) * step);
  if (to - speeds.back() > 1e-9 * step) speeds.push_back(to);
  return speeds;
}

}  // namespace floatframe
