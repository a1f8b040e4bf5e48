#pragma once
// A number as OpenCRG files write it: of Fortran, whose exponents may begin with D, or with nothing
// before the point, or a plus.
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

namespace floatframe {

/// If the whole text, without blanks around it, is a finite one.
inline std::optional<double> crg_number(std::string_view text) noexcept {
  if (text.starts_with('+')) text.remove_prefix(1);
  char copy[64];
  if (text.empty() || text.size() > sizeof copy) return std::nullopt;
  for (std::size_t k = 0; k < text.size(); ++k)
    copy[k] = text[k] == 'd' || text[k] == 'D' ? 'e' : text[k];
  double x = 0.0;
  const auto [end, error] = std::from_chars(copy, copy + text.size(), x);
  if (error != std::errc() || end != copy + text.size() || !std::isfinite(x)) return std::nullopt;
  return x;
}

}  // namespace floatframe
