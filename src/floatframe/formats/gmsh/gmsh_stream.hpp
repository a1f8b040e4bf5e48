#pragma once
// Numbers and lines of a .msh file in order, ASCII or binary of either byte order, with their
// location. A count in the file is accepted only if the remaining bytes can hold so many entries.
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

class GmshStream {
 public:
  GmshStream(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  void set_binary(bool swapped) noexcept {
    binary_ = true;
    swapped_ = swapped;
  }
  bool binary() const noexcept { return binary_; }

  /// Location of an error: the line of an ASCII file, the byte (from 0) of a binary one.
  struct Place {
    int line = 0;
    std::size_t byte = 0;
  };
  /// Location of the next number.
  Place here();
  ErrorEntry error(ErrorCode code, const Place& at, std::string message) const;
  template <class... Values>
  [[noreturn]] void stop(ErrorCode code, const Place& at, fmt::format_string<Values...> text,
                         Values&&... values) const {
    throw InputError({error(code, at, fmt::format(text, std::forward<Values>(values)...))});
  }
  template <class... Values>
  [[noreturn]] void stop(ErrorCode code, fmt::format_string<Values...> text, Values&&... values) {
    stop(code, here(), text, std::forward<Values>(values)...);
  }

  /// The next line, trimmed, ASCII in all files; false at the end.
  bool next_line(std::string_view& line);
  /// Skips everything up to and including the line "$End<section>". `begin`: of the
  /// section.
  void end_section(const Place& begin, std::string_view section);
  /// The same when all numbers were read: anything before the end is an error.
  void expect_end(std::string_view section);

  int integer(const char* what);
  std::uint64_t size(const char* what);
  double real(const char* what);
  /// Bytes that remain.
  std::size_t left() const noexcept { return text_.size() - at_; }
  /// A count of entries of at least so many numbers each.
  std::uint64_t count(const char* what, std::size_t numbers_each);
  void check_count(const Place& at, std::uint64_t count, const char* what,
                   std::size_t numbers_each) const;

 private:
  void skip_blanks() noexcept;
  std::string_view token(const char* what);
  template <class T>
  T raw(const char* what);
  /// `from`: " from 0" where that is the least.
  template <class T>
  T whole(const char* what, const char* from);

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool binary_ = false, swapped_ = false;
};

}  // namespace floatframe
