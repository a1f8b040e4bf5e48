#include "floatframe/model/input_value.hpp"

#include <fmt/format.h>

namespace floatframe {

std::string input_expectation(const Input& input) {
  const std::string unit = input.unit.empty() ? "" : " [" + input.unit + "]";
  if (std::isinf(input.low) && std::isinf(input.high)) return "a number" + unit;
  if (std::isinf(input.high)) return fmt::format("a number of at least {:g}{}", input.low, unit);
  if (std::isinf(input.low)) return fmt::format("a number of at most {:g}{}", input.high, unit);
  return fmt::format("a number from {:g} to {:g}{}", input.low, input.high, unit);
}

}  // namespace floatframe
