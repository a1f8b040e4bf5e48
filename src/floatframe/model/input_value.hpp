#pragma once
// The rule for values of inputs from any source: a program, a packet, a saved state.
#include <cmath>
#include <optional>
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// The value that an input takes: the given one or, for an input with `clamp`, the nearer limit.
/// Nothing if it is not finite, or outside of the limits of an input without `clamp`.
inline std::optional<double> accepted_value(const Input& input, double value) noexcept {
  if (!std::isfinite(value)) return std::nullopt;
  if (value >= input.low && value <= input.high) return value;
  if (!input.clamp) return std::nullopt;
  return value < input.low ? input.low : input.high;
}

/// What an input may be set to, as errors say it: "a number from 0 to 5 [N]".
std::string input_expectation(const Input& input);

}  // namespace floatframe
