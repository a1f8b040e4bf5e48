#pragma once
// A fingerprint of data: two inputs with the same fingerprint are assumed equal. 128-bit FNV-1a:
// fast, the same on every machine, not secure against deliberate collisions.
#include <cstdint>
#include <string>
#include <string_view>

namespace floatframe {

class ContentHash {
 public:
  /// Length and bytes, so that "ab", "c" and "a", "bc" differ.
  ContentHash& add(std::string_view bytes) noexcept;
  ContentHash& add(std::uint64_t number) noexcept;
  /// Bytes alone: for a text that arrives in pieces of any size.
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
