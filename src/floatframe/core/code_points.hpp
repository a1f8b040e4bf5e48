#pragma once
// UTF-8 text as code points, for files in UTF-16 or UTF-32. Bytes that are not valid UTF-8 become
// U+FFFD.
#include <string>
#include <string_view>

#include "floatframe/core/printable.hpp"

namespace floatframe {

inline std::u32string code_points(std::string_view text) {
  std::u32string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto lead = static_cast<unsigned char>(text[at]);
    if (length == 0) {
      out += U'\ufffd';
      ++at;
      continue;
    }
    char32_t code = length == 1 ? lead : lead & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k)
      code = code << 6 | (static_cast<unsigned char>(text[at + k]) & 0x3fu);
    out += code;
    at += length;
  }
  return out;
}

/// Back to UTF-8; what is no code point becomes U+FFFD.
inline std::string utf8_of(std::u32string_view text) {
  std::string out;
  for (char32_t code : text) {
    if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) code = U'\ufffd';
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    const char32_t lead = more == 0 ? 0 : 0xff00 >> (more + 1) & 0xff;
    out += static_cast<char>(lead | code >> (6 * more));
    for (int k = more - 1; k >= 0; --k) out += static_cast<char>(0x80 | (code >> (6 * k) & 0x3f));
  }
  return out;
}

}  // namespace floatframe
