#pragma once
// Texts that are kept without allocating: messages must be there when memory is not.
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace floatframe {

/// As much of `text` as `size` bytes hold with the 0 behind it; no character is cut in two. Does
/// nothing without room.
void copy_text(std::string_view text, char* to, std::size_t size) noexcept;

class BoundedText {
 public:
  const char* c_str() const noexcept { return text_.data(); }
  void set(std::string_view text) noexcept { copy_text(text, text_.data(), text_.size()); }
  /// The sentence in the words of fmt. Its numbers and texts are formatted in place.
  template <class... Args>
  void format(fmt::format_string<Args...> sentence, Args&&... args) {
    std::array<char, 1024> whole;
    const auto done =
        fmt::format_to_n(whole.data(), whole.size(), sentence, std::forward<Args>(args)...);
    const std::string_view text(whole.data(), done.out);
    copy_text(text, text_.data(), done.size > whole.size() ? text.size() : text_.size());
  }

 private:
  std::array<char, 4096> text_{};
};

}  // namespace floatframe
