#include "floatframe/core/excerpt.hpp"

#include <cstddef>

namespace floatframe {

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest_excerpt = 60;
  if (text.size() <= longest_excerpt) return std::string(text);
  std::size_t end = longest_excerpt;  // not inside a multi-byte character
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace floatframe
