#pragma once
// A file that grows by whole lines or whole blocks. Any end of the program, even SIGKILL, keeps
// everything appended before; only a power failure may lose data that `to_disk` has not confirmed.
// A full disk or a size limit leaves whole lines or blocks as well.
#include <cstdint>
#include <string>
#include <string_view>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/output_error.hpp"

namespace floatframe {

class GrowingFile {
 public:
  /// Length of a file and fingerprint of its content.
  struct Position {
    std::uint64_t bytes = 0;
    std::string content;  ///< fingerprint
  };

  /// Creates an empty file and replaces an existing one. With `hashed` the position includes a
  /// fingerprint of the content, so that the file can be continued. Throws OutputError.
  explicit GrowingFile(const std::string& path, bool hashed = false);
  /// Continues the file from `position`; removes data behind it. Throws InputError if there is no
  /// such file or if the content before the position has changed, OutputError if it cannot be
  /// written.
  GrowingFile(const std::string& path, const Position& position);
  /// Throws InputError if the file cannot be continued from the position. Changes nothing.
  static void require(const std::string& path, const Position& position);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Whole lines. Throws OutputError; keeps the lines that could be written.
  void append(std::string_view lines);
  /// One block: all of it, or nothing. Throws OutputError.
  void append_whole(std::string_view block);
  /// Waits until all data is safe against a power failure. Throws OutputError.
  void to_disk();

  std::uint64_t bytes() const noexcept { return bytes_; }
  /// For a hashed file.
  Position position() const { return {bytes_, content_.text()}; }

 private:
  GrowingFile(const std::string& path, const Position& position, int flags);
  void read_up_to(const Position& position);
  std::size_t write(std::string_view bytes, int& error);
  void keep(std::string_view bytes, int error);

  std::string path_;
  int file_ = -1;
  bool hashed_;
  std::uint64_t bytes_ = 0;
  ContentHash content_;
};

}  // namespace floatframe
