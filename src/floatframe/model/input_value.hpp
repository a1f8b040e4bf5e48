#pragma once
// The rule for values of inputs from any source: a program, a packet, a saved state.
#include <cmath>
#include <optional>

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

}  // namespace floatframe
