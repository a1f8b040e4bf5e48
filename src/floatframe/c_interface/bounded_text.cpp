#include "floatframe/c_interface/bounded_text.hpp"

#include <cstring>

namespace floatframe {
namespace {

bool continues_a_character(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

}  // namespace

void copy_text(std::string_view text, char* to, std::size_t size) noexcept {
  if (to == nullptr || size == 0) return;
  std::size_t n = text.size();
  if (n >= size) {
    n = size - 1;
    while (n > 0 && continues_a_character(text[n])) --n;
  }
  if (n > 0) std::memmove(to, text.data(), n);
  to[n] = '\0';
}

}  // namespace floatframe
