#pragma once
// A file that grows on disk while it is made, by whole lines or whole blocks. What ends the program
// later, be it SIGKILL, leaves all that was appended before; only a power failure may take what
// `to_disk` has not confirmed. A disk that is full, or a limit that is reached, leaves whole ones
// as well.
#include <cstdint>
#include <string>
#include <string_view>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/output_error.hpp"

namespace floatframe {

class GrowingFile {
 public:
  /// Where a file ends, and what is before.
  struct Position {
    std::uint64_t bytes = 0;
    std::string content;  ///< fingerprint
  };

  /// A new and empty file, in place of one that is there. With `hashed` the position knows its
  /// content, so that the file can be continued. Throws OutputError.
  explicit GrowingFile(const std::string& path, bool hashed = false);
  /// Continues the file from `position`; what is behind it goes. Throws InputError if there is no
  /// such file or what is before the position is not what it was, OutputError if it cannot be
  /// written.
  GrowingFile(const std::string& path, const Position& position);
  /// Throws InputError if the file cannot be continued from there. Changes nothing.
  static void require(const std::string& path, const Position& position);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Whole lines. Throws OutputError; of the lines those that fitted in are kept.
  void append(std::string_view lines);
  /// One block: all of it, or nothing. Throws OutputError.
  void append_whole(std::string_view block);
  /// Waits until a power failure would leave all of it. Throws OutputError.
  void to_disk();

  std::uint64_t bytes() const noexcept { return bytes_; }
  /// Of a file that is hashed.
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
