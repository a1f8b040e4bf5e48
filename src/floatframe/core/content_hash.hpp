#pragma once
// A fingerprint of data: two inputs with the same fingerprint are taken to be the same. 128-bit
// FNV-1a: quick, the same on every machine, not meant against somebody who wants a collision.
#include <cstdint>
#include <string>
#include <string_view>

namespace floatframe {

class ContentHash {
 public:
  /// Length and bytes, so that "ab", "c" and "a", "bc" differ.
  ContentHash& add(std::string_view bytes) noexcept;
  ContentHash& add(std::uint64_t number) noexcept;
  /// Bytes alone: of a text that comes in pieces, wherever it is cut.
  ContentHash& append(std::string_view bytes) noexcept;
  /// 32 hexadecimal digits.
  std::string text() const;

 private:
  void mix(unsigned char byte) noexcept;
  // The offset basis of FNV-128: upper and lower half.
  std::uint64_t high_ = 0x6c62272e07bb0142u, low_ = 0x62b821756295c58du;
};

/// Fingerprint of one text.
std::string content_hash(std::string_view bytes);

}  // namespace floatframe
