#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

unsigned byte(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) noexcept {
  const unsigned a = byte(text, at), b = byte(text, at + 1);
  const auto tail = [&](std::size_t k) { return (byte(text, at + k) & 0xC0u) == 0x80u; };
  if (a < 0x80) return at < text.size() ? 1 : 0;
  if (a >= 0xC2 && a <= 0xDF) return tail(1) ? 2 : 0;
  if (a == 0xE0 && b < 0xA0) return 0;   // overlong
  if (a == 0xED && b >= 0xA0) return 0;  // surrogates
  if (a >= 0xE0 && a <= 0xEF) return tail(1) && tail(2) ? 3 : 0;
  if (a == 0xF0 && b < 0x90) return 0;
  if (a == 0xF4 && b >= 0x90) return 0;  // above U+10FFFF
  if (a >= 0xF0 && a <= 0xF4) return tail(1) && tail(2) && tail(3) ? 4 : 0;
  return 0;
}

bool is_control(std::string_view text, std::size_t at) noexcept {
  const unsigned a = byte(text, at), b = byte(text, at + 1);
  return a < 0x20 || a == 0x7F || (a == 0xC2 && b >= 0x80 && b < 0xA0);
}

std::string printable(std::string_view text, bool lines) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t n = utf8_length(text, k);
    if (n > 0 && !is_control(text, k)) {
      out += text.substr(k, n);
      k += n;
      continue;
    }
    const unsigned c = byte(text, k);
    if (c == '\n') {
      out += lines ? "\n" : "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else {
      out += "\\x";
      out += digits[c / 16];
      out += digits[c % 16];
    }
    ++k;
  }
  return out;
}

}  // namespace floatframe
