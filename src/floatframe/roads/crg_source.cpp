#include "floatframe/roads/crg_source.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/regular_file.hpp"

namespace floatframe {
namespace {

constexpr std::size_t room = std::size_t{1} << 17;
constexpr std::size_t longest_line = std::size_t{1} << 16;

}  // namespace

CrgSource::CrgSource(const std::filesystem::path& file)
    : name_(file.string()),
      file_(std::make_unique<RegularFile>(file)),
      buffer_(room),
      size_(file_->size()) {}

CrgSource::CrgSource(std::string_view content, std::string name)
    : name_(std::move(name)), text_(content), buffer_(room), size_(content.size()) {}

CrgSource::~CrgSource() = default;

/// More bytes behind those in the buffer; false at the end.
bool CrgSource::fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  std::size_t got = 0;
  if (file_) {
    got = file_->read(buffer_.data() + end_, buffer_.size() - end_);
  } else {
    got = std::min(text_.size(), buffer_.size() - end_);
    std::copy_n(text_.data(), got, buffer_.data() + end_);
    text_.remove_prefix(got);
  }
  end_ += got;
  return got > 0;
}

std::optional<std::string_view> CrgSource::line() {
  std::size_t looked = 0;
  for (;;) {
    const std::string_view all(buffer_.data() + begin_, end_ - begin_);
    const std::size_t at = all.find('\n', looked);
    looked = all.size();
    const bool found = at != std::string_view::npos;
    if (!found && looked < longest_line && fill()) continue;
    if (!found && looked >= longest_line)
      throw InputError(ErrorCode::damaged, {name_, 0, 0},
                       "found a line of more than 65536 characters, expected an OpenCRG file");
    if (!found && looked == 0) return std::nullopt;
    const std::size_t length = found ? at : looked;
    std::string_view out(buffer_.data() + begin_, length);
    begin_ += found ? length + 1 : length;
    taken_ += found ? length + 1 : length;
    if (out.ends_with('\r')) out.remove_suffix(1);
    return out;
  }
}

std::string_view CrgSource::bytes(std::size_t count) {
  count = std::min(count, buffer_.size());
  while (end_ - begin_ < count && fill()) {
  }
  const std::string_view out(buffer_.data() + begin_, std::min(count, end_ - begin_));
  begin_ += out.size();
  taken_ += out.size();
  return out;
}

}  // namespace floatframe
