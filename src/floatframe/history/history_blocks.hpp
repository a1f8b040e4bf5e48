#pragma once
// The result file `states.ffr` as blocks (docs/result-file.md). All numbers are little-endian.
//
//   byte 0    8 bytes  "floatfr\n"
//   byte 8    u32      version of the format, 1
//   byte 12   u32      0
//   byte 16   blocks, each
//     u64      length n of its content in bytes
//     4 bytes  kind: HEAD, DATA, ROWS, DONE
//     u32      CRC-32 (that of zlib) of the 12 bytes before it and the content
//     n bytes  content
//     zeros up to the next multiple of 8
//
// HEAD comes first, once: JSON. Then one DATA block for each array listed in the header, in its
// order. Then any number of ROWS: whole rows of doubles. DONE, JSON, ends the file of a completed
// or failed run.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

inline constexpr std::string_view history_magic = "floatfr\n";
inline constexpr std::uint32_t history_version = 1;
inline constexpr std::uint64_t history_start = 16, history_block_head = 16;

enum class HistoryBlockKind { head, data, rows, done };

/// A block of ROWS has at most this size, or one row, to limit the loss at the end of a file.
inline constexpr std::uint64_t largest_rows_block = std::uint64_t{1} << 20;
inline constexpr std::uint64_t largest_history_head = std::uint64_t{64} << 20;
inline constexpr std::uint64_t largest_history_end = std::uint64_t{64} << 10;

/// The first bytes of a file.
std::string history_beginning();
std::string history_block(HistoryBlockKind kind, std::string_view content);

/// Location of a block.
struct HistoryBlock {
  HistoryBlockKind kind = HistoryBlockKind::head;
  std::uint64_t at = 0, length = 0;  ///< of its content [byte]
};

/// Reads `size` bytes of a file from offset `at`.
using HistoryBytes = std::function<void(std::uint64_t at, char* out, std::size_t size)>;

/// Iterates over the blocks of a file of `size` bytes and verifies their checksums.
class HistoryWalk {
 public:
  /// `name` is for messages. Throws InputError if this is not a result file, or of another version.
  HistoryWalk(HistoryBytes bytes, std::uint64_t size, std::string name);

  /// False: there are no more. `longest`: maximum size of the content. Throws InputError for a
  /// damaged block; a block truncated at the end of the file is ignored.
  bool next(HistoryBlock& block, std::uint64_t longest);
  /// A sentence on data ignored at the end, or empty.
  const std::string& dropped() const noexcept { return dropped_; }
  [[noreturn]] void refuse(ErrorCode code, const std::string& what) const;

 private:
  bool torn(std::uint64_t longest);

  HistoryBytes bytes_;
  std::uint64_t size_, at_ = history_start;
  std::string name_, dropped_;
};

}  // namespace floatframe
