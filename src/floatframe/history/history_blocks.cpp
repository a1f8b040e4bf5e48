#include "floatframe/history/history_blocks.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/enum_index.hpp"

namespace floatframe {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are kept");

constexpr std::array<std::string_view, 4> kind_words{"HEAD", "DATA", "ROWS", "DONE"};

std::uint32_t crc_on(std::uint32_t crc, const char* bytes, std::size_t size) {
  uLong sum = crc;
  while (size > 0) {  // zlib uses 32-bit sizes
    const std::size_t piece = std::min(size, std::size_t{1} << 30);
    sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(piece));
    bytes += piece;
    size -= piece;
  }
  return static_cast<std::uint32_t>(sum);
}

template <class Number>
void put(std::string& out, Number x) {
  char bytes[sizeof x];
  std::memcpy(bytes, &x, sizeof x);
  out.append(bytes, sizeof x);
}

template <class Number>
Number number_at(const char* bytes) {
  Number x;
  std::memcpy(&x, bytes, sizeof x);
  return x;
}

constexpr std::uint64_t padded(std::uint64_t length) { return (length + 7) / 8 * 8; }

}  // namespace

std::string history_beginning() {
  std::string out(history_magic);
  put(out, history_version);
  put(out, std::uint32_t{0});
  return out;
}

std::string history_block(HistoryBlockKind kind, std::string_view content) {
  std::string out;
  out.reserve(history_block_head + padded(content.size()));
  put(out, static_cast<std::uint64_t>(content.size()));
  out += kind_words[index_of(kind)];
  const std::uint32_t head = crc_on(0, out.data(), out.size());
  put(out, crc_on(head, content.data(), content.size()));
  out += content;
  out.resize(history_block_head + padded(content.size()), '\0');
  return out;
}

HistoryWalk::HistoryWalk(HistoryBytes bytes, std::uint64_t size, std::string name)
    : bytes_(std::move(bytes)), size_(size), name_(std::move(name)) {
  char start[history_start] = {};
  bytes_(0, start, static_cast<std::size_t>(std::min(size_, history_start)));
  if (size_ < history_start || std::string_view(start, history_magic.size()) != history_magic)
    refuse(ErrorCode::wrong_file,
           "this is not a result file of a run (states.ffr): it does not begin as one");
  const auto version = number_at<std::uint32_t>(start + 8);
  if (version != history_version)
    refuse(ErrorCode::mismatch,
           fmt::format("found version {} of result files, this program reads version {}", version,
                       history_version));
}

void HistoryWalk::refuse(ErrorCode code, const std::string& what) const {
  throw InputError(code, SourceMark{name_, 0, 0}, what);
}

/// Called where no valid block follows: true if the rest can be a block that was being written.
bool HistoryWalk::torn(std::uint64_t longest) {
  const std::uint64_t left = size_ - at_;
  if (left > history_block_head + padded(longest))
    refuse(ErrorCode::damaged, fmt::format("the block at byte {} is damaged", at_));
  dropped_ =
      fmt::format("the last {} bytes are a block that was not written to its end: left out", left);
  return false;
}

bool HistoryWalk::next(HistoryBlock& block, std::uint64_t longest) {
  if (at_ >= size_) return false;
  const std::uint64_t left = size_ - at_;
  if (left < history_block_head) return torn(longest);
  char head[history_block_head];
  bytes_(at_, head, sizeof head);
  const auto length = number_at<std::uint64_t>(head);
  const auto kind = std::find(kind_words.begin(), kind_words.end(), std::string_view(head + 8, 4));
  if (kind == kind_words.end()) {
    const bool blank = std::all_of(head, head + sizeof head, [](char c) { return c == '\0'; });
    if (blank) return torn(longest);  // space left empty by a power failure
    refuse(ErrorCode::damaged,
           fmt::format("the block at byte {} is damaged: it is of no known kind", at_));
  }
  if (length > longest)
    refuse(ErrorCode::damaged,
           fmt::format(
               "the block at byte {} is damaged: found a length of {} bytes, expected {} at most",
               at_, length, longest));
  if (padded(length) > left - history_block_head) return torn(longest);
  std::uint32_t crc = crc_on(0, head, 12);
  std::vector<char> piece(static_cast<std::size_t>(std::min<std::uint64_t>(length, 1u << 20)));
  const std::uint64_t content = at_ + history_block_head;
  for (std::uint64_t done = 0; done < length;) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(length - done, piece.size()));
    bytes_(content + done, piece.data(), n);
    crc = crc_on(crc, piece.data(), n);
    done += n;
  }
  if (crc != number_at<std::uint32_t>(head + 12)) {
    if (content + padded(length) == size_) return torn(longest);
    refuse(
        ErrorCode::damaged,
        fmt::format("the block at byte {} is damaged: its checksum does not fit its content", at_));
  }
  block = {static_cast<HistoryBlockKind>(kind - kind_words.begin()), content, length};
  at_ = content + padded(length);
  return true;
}

}  // namespace floatframe
