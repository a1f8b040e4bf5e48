#pragma once
// Lines of ANSYS decks as commands with fields, and lines of their blocks in columns of a Fortran
// format.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// (3i9,6e21.13e3) is 'i' 9 three times, then 'e' 21 six times; a scale factor (1P) is ignored.
struct FortranColumns {
  std::vector<std::pair<char, int>> columns;  ///< kind in lower case, width
  std::size_t integers() const noexcept;      ///< columns 'i' at the beginning
  /// The cells of a line, trimmed; those beyond its end are missing. The rest of the line after the
  /// last column.
  std::string_view split(std::string_view line, std::vector<std::string_view>& cells) const;
};

/// One command after the other. Comments (behind `!`), empty lines and `/COM` are ignored; `$`
/// separates commands in one line. Errors of form stop the reading, since the rest cannot be
/// interpreted.
class AnsysFields {
 public:
  explicit AnsysFields(TextSource& source) : source_(source) {}

  /// False at the end of the file.
  bool next();
  /// In upper case: "NBLOCK", "/PREP7", "*SET".
  const std::string& command() const noexcept { return command_; }
  /// As MAPDL identifies commands: by the first four characters of those without `/` and `*`.
  bool is(std::string_view name) const noexcept;
  const std::string& line() const noexcept { return line_; }
  FeSource at() const noexcept { return at_; }
  TextSource& source() noexcept { return source_; }

  /// Field 0 is the command; empty if it is missing.
  std::string_view text(std::size_t k) const noexcept;
  std::size_t size() const noexcept { return fields_.size(); }
  /// Like text, in upper case.
  std::string word(std::size_t k) const;
  bool blank(std::size_t k) const noexcept { return text(k).empty(); }
  /// A number, or a parameter that the deck has set; a blank field is `missing`.
  double real(std::size_t k, const char* what, double missing = 0.0);
  int integer(std::size_t k, const char* what, int missing = 0);
  /// A whole number of at least 1.
  int label(std::size_t k, const char* what);
  /// All fields from an index on.
  std::vector<double> reals(std::size_t first, const char* what);
  /// Three of them.
  Vec3 three(std::size_t first, const char* what);
  /// If the field is a number or such a parameter.
  std::optional<double> number(std::size_t k) const;
  /// `NAME=value` or *SET; nothing: a text or an expression.
  void set_parameter(std::string_view name, std::optional<double> value);

  /// The format line of a block.
  FortranColumns columns();
  /// The next line of a block in its columns, of which the last ones may be missing; false at a
  /// line that begins with -1 or with a letter, which is then read as a command.
  bool row(const FortranColumns& format);
  /// The next line of a block, fields between commas or blanks; false at a command.
  bool loose_row();
  /// Lines up to the next command.
  void skip_block();
  /// Of the last row; 0 where it has no cell.
  std::size_t cells() const noexcept { return cells_.size(); }
  int cell_integer(std::size_t k, const char* what);
  double cell_real(std::size_t k, const char* what);
  /// All whole numbers, all reals from a cell on.
  void append_cells(std::size_t first, const char* what, std::vector<int>& out);
  void append_cells(std::size_t first, const char* what, std::vector<double>& out);

  template <class... Values>
  [[noreturn]] void stop(ErrorCode code, fmt::format_string<Values...> text, Values&&... values) {
    source_.stop(code, at_, fmt::format(text, std::forward<Values>(values)...));
  }

 private:
  bool block_line(std::string_view& line);
  template <class Value>
  Value cell(std::size_t k, const char* what, std::optional<Value> (*parse)(std::string_view),
             std::string (*wrong)(std::string_view));
  void split(std::string_view command);

  TextSource& source_;
  std::string line_, command_;
  std::vector<std::string> waiting_;  // commands of the same line behind `$`, last first
  std::vector<std::string_view> fields_, cells_;
  FeSource at_;
  std::map<std::string, std::optional<double>, std::less<>> parameters_;
};

}  // namespace floatframe
