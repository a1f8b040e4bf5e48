#include "floatframe/core/content_hash.hpp"

namespace floatframe {

void ContentHash::mix(unsigned char byte) noexcept {
  __extension__ typedef unsigned __int128 Wide;
  // The prime of FNV-128 is 2^88 + 2^8 + 0x3b.
  const Wide prime = (static_cast<Wide>(1) << 88) + 0x13b;
  const Wide x = ((static_cast<Wide>(high_) << 64) | (low_ ^ byte)) * prime;
  high_ = static_cast<std::uint64_t>(x >> 64);
  low_ = static_cast<std::uint64_t>(x);
}

ContentHash& ContentHash::add(std::uint64_t number) noexcept {
  for (int k = 0; k < 8; ++k) mix(static_cast<unsigned char>(number >> (8 * k)));
  return *this;
}

ContentHash& ContentHash::add(std::string_view bytes) noexcept {
  return add(static_cast<std::uint64_t>(bytes.size())).append(bytes);
}

ContentHash& ContentHash::append(std::string_view bytes) noexcept {
  for (const char c : bytes) mix(static_cast<unsigned char>(c));
  return *this;
}

std::string ContentHash::text() const {
  static const char digits[] = "0123456789abcdef";
  std::string out;
  for (const std::uint64_t half : {high_, low_})
    for (int shift = 60; shift >= 0; shift -= 4) out += digits[(half >> shift) & 15u];
  return out;
}

std::string content_hash(std::string_view bytes) { return ContentHash().add(bytes).text(); }

}  // namespace floatframe
