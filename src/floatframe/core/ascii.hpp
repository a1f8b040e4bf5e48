#pragma once
// Character classes of the input languages, independent of the locale of the process.

namespace floatframe {

constexpr bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

}  // namespace floatframe
