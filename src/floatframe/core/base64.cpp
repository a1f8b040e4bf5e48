#include "floatframe/core/base64.hpp"

#include <cstdint>

namespace floatframe {

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto bits = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k]));
  };
  std::string out((bytes.size() + 2) / 3 * 4, '=');
  std::size_t k = 0;
  char* to = out.data();
  for (; k + 3 <= bytes.size(); k += 3) {
    const std::uint32_t three = bits(k) << 16 | bits(k + 1) << 8 | bits(k + 2);
    for (const int shift : {18, 12, 6, 0}) *to++ = digits[three >> shift & 63u];
  }
  const std::size_t left = bytes.size() - k;
  if (left == 0) return out;
  const std::uint32_t rest = bits(k) << 16 | (left > 1 ? bits(k + 1) << 8 : 0u);
  for (std::size_t i = 0; i <= left; ++i) *to++ = digits[rest >> (18 - 6 * i) & 63u];
  return out;
}

std::optional<std::string> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::size_t padding = 0;
  while (padding < 2 && !text.empty() && text.back() == '=') {
    text.remove_suffix(1);
    ++padding;
  }
  std::string out;
  out.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (digit < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out += static_cast<char>(bits >> held & 255u);
  }
  return out;
}

}  // namespace floatframe
