#include "floatframe/core/utf8_text.hpp"

#include "floatframe/core/printable.hpp"

namespace floatframe {

std::string utf8_text(std::string_view text) {
  bool valid = true;
  for (std::size_t at = 0; at < text.size() && valid;) {
    const std::size_t length = utf8_length(text, at);
    valid = length > 0;
    at += length;
  }
  if (valid) return std::string(text);
  std::string out;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x80) {
      out += character;
    } else {
      out += static_cast<char>(0xc0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return out;
}

}  // namespace floatframe
