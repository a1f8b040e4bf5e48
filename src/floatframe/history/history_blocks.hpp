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
// HEAD comes first, once: JSON. Then one DATA block for each array the header lists, in its order.
// Then any number of ROWS: whole rows of doubles. DONE, JSON, ends the file of a run that has
// ended.
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

/// A block of ROWS holds no more bytes, or one row: what may be lost at the end of a file is small.
inline constexpr std::uint64_t largest_rows_block = std::uint64_t{1} << 20;
inline constexpr std::uint64_t largest_history_head = std::uint64_t{64} << 20;
inline constexpr std::uint64_t largest_history_end = std::uint64_t{64} << 10;

/// The beginning of a file.
std::string history_beginning();
std::string history_block(HistoryBlockKind kind, std::string_view content);

/// Where a block stands.
struct HistoryBlock {
  HistoryBlockKind kind = HistoryBlockKind::head;
  std::uint64_t at = 0, length = 0;  ///< of its content [byte]
};

/// Gives `size` bytes of a file from `at` on.
using HistoryBytes = std::function<void(std::uint64_t at, char* out, std::size_t size)>;

/// Walks through the blocks of a file of `size` bytes and checks each against its checksum.
class HistoryWalk {
 public:
  /// `name` is for messages. Throws InputError if this is no result file, or one of another
  /// version.
  HistoryWalk(HistoryBytes bytes, std::uint64_t size, std::string name);

  /// False: there is no further one. `longest`: bytes that the content may have. Throws InputError
  /// for a block that is damaged; one that is cut off at the end of the file is not one.
  bool next(HistoryBlock& block, std::uint64_t longest);
  /// What was left out at the end, in a sentence, or empty.
  const std::string& dropped() const noexcept { return dropped_; }
  [[noreturn]] void refuse(ErrorCode code, const std::string& what) const;

 private:
  bool torn(std::uint64_t longest);

  HistoryBytes bytes_;
  std::uint64_t size_, at_ = history_start;
  std::string name_, dropped_;
};

}  // namespace floatframe
