#include "floatframe/formats/gmsh/gmsh_stream.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

GmshStream::Place GmshStream::here() {
  if (!binary_) skip_blanks();
  return {line_, at_};
}

ErrorEntry GmshStream::error(ErrorCode code, const Place& at, std::string message) const {
  if (binary_) return {{name_, 0, 0}, code, fmt::format("byte {}: {}", at.byte, message)};
  return {{name_, at.line, 0}, code, std::move(message)};
}

bool GmshStream::next_line(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = trimmed(text_.substr(at_, end - at_));
  at_ = std::min(end + 1, text_.size());
  ++line_;
  return true;
}

void GmshStream::end_section(const Place& begin, std::string_view section) {
  const std::string end = fmt::format("$End{}", section);
  const std::size_t found = text_.find(end, at_);
  if (found == std::string_view::npos)
    stop(ErrorCode::damaged, begin, "section ${} has no end: '{}' is missing", section, end);
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
  at_ = found;
  std::string_view line;
  next_line(line);
}

void GmshStream::expect_end(std::string_view section) {
  skip_blanks();
  const Place at = here();
  const std::string end = fmt::format("$End{}", section);
  const std::string_view rest = text_.substr(at_);
  if (!rest.starts_with(end))
    stop(ErrorCode::damaged, at, "{}",
         rest.empty()
             ? fmt::format("the file ends where '{}' was expected", end)
             : fmt::format("found {}, expected '{}': section ${} has more than it counts",
                           shown(rest.substr(0, std::min(rest.find('\n'), std::size_t{30}))), end,
                           section));
  std::string_view line;
  next_line(line);
}

void GmshStream::skip_blanks() noexcept {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return;
    if (c == '\n') ++line_;
    ++at_;
  }
}

std::string_view GmshStream::token(const char* what) {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) > ' ') ++at_;
  if (at_ == begin) stop(ErrorCode::damaged, "the file ends where {} was expected", what);
  return text_.substr(begin, at_ - begin);
}

template <class T>
T GmshStream::raw(const char* what) {
  if (left() < sizeof(T))
    stop(ErrorCode::damaged, "the file ends where {} was expected ({} bytes are left)", what,
         left());
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, text_.data() + at_, sizeof(T));
  if (swapped_) std::reverse(bytes, bytes + sizeof(T));
  at_ += sizeof(T);
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
T GmshStream::whole(const char* what, const char* from) {
  if (binary_) return raw<T>(what);
  const Place at = here();
  const std::string_view field = token(what);
  T value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    stop(ErrorCode::not_a_number, at, "found {}, expected {}, a whole number{}", shown(field), what,
         from);
  return value;
}

int GmshStream::integer(const char* what) { return whole<std::int32_t>(what, ""); }

std::uint64_t GmshStream::size(const char* what) { return whole<std::uint64_t>(what, " from 0"); }

double GmshStream::real(const char* what) {
  const Place at = here();
  if (binary_) {
    const double value = raw<double>(what);
    if (!std::isfinite(value)) stop(ErrorCode::not_finite, at, "{} is not a finite number", what);
    return value;
  }
  const std::string_view field = token(what);
  const auto value = parse_real(field);
  if (!value) stop(ErrorCode::not_a_number, at, "{}; expected {}", not_a_real(field), what);
  return *value;
}

std::uint64_t GmshStream::count(const char* what, std::size_t numbers_each) {
  const Place at = here();
  const std::uint64_t value = size(what);
  check_count(at, value, what, numbers_each);
  return value;
}

void GmshStream::check_count(const Place& at, std::uint64_t count, const char* what,
                             std::size_t numbers_each) const {
  const std::size_t smallest = binary_ ? 4 : 2;  // an ASCII number and its blank
  if (count > left() / (smallest * std::max(numbers_each, std::size_t{1})) + 1)
    stop(ErrorCode::damaged, at,
         "{} is {}, more than the {} bytes that are left of the file can hold", what, count,
         left());
}

}  // namespace floatframe
