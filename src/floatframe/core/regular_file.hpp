#pragma once
// All user files are read here: regular files below a given size, so that a pipe cannot hang the
// program and a device cannot fill the memory. The file is checked after it was opened, since its
// name may refer to another file a moment later.
#include <cstdint>
#include <filesystem>
#include <string>

namespace floatframe {

/// Limit for all files; some formats have lower limits.
inline constexpr std::uint64_t largest_file_read = std::uint64_t{4} << 30;  ///< [byte]

/// Reads the whole file into `content`. Returns empty on success, else the reason as it follows the
/// name of the file: "the file does not exist", "this is a folder, not a file", "this is not a
/// regular file", "the file is larger than 16 MiB, which is not read", ...; `content` is then
/// empty.
std::string read_regular_file(const std::filesystem::path& file, std::uint64_t largest,
                              std::string& content);

/// The same for the first `bytes` at most, of a file of any size.
std::string read_regular_beginning(const std::filesystem::path& file, std::size_t bytes,
                                   std::string& content);

/// The whole file; throws InputError with its name.
std::string regular_file(const std::filesystem::path& file,
                         std::uint64_t largest = largest_file_read);

/// A regular file of any size that is read piece by piece. Throws InputError with its name.
class RegularFile {
 public:
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;
  /// When it was opened [byte].
  std::uint64_t size() const noexcept { return size_; }
  /// The next bytes, at most `count`; 0 at the end.
  std::size_t read(char* to, std::size_t count);

 private:
  std::string name_;
  int number_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace floatframe
