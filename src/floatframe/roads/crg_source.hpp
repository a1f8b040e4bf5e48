#pragma once
// The bytes of a file or of a text, line by line and then number by number.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

class RegularFile;

class CrgSource {
 public:
  explicit CrgSource(const std::filesystem::path& file);
  CrgSource(std::string_view content, std::string name);
  ~CrgSource();

  const std::string& name() const noexcept { return name_; }
  /// Bytes that were not taken yet, as far as the size of the file was known.
  std::uint64_t left() const noexcept { return size_ > taken_ ? size_ - taken_ : 0; }
  /// The next line without its end, valid until the next call; nothing at the end. Throws
  /// InputError if it is longer than 64 KiB.
  std::optional<std::string_view> line();
  /// The next bytes; fewer at the end.
  std::string_view bytes(std::size_t count);

 private:
  bool fill();

  std::string name_;
  std::unique_ptr<RegularFile> file_;  ///< none: a text
  std::string_view text_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer
  std::uint64_t size_ = 0, taken_ = 0;
};

}  // namespace floatframe
