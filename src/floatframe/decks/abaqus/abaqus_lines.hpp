#pragma once
// The lines of an Abaqus or CalculiX deck: keyword lines with parameters, data lines, comments,
// continuation lines and *INCLUDE. Keywords, parameters and names do not depend on case or blanks.
#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

struct AbaqusKeyword {
  struct Parameter {
    std::string name;   ///< upper case without blanks: "REFNODE"
    std::string value;  ///< as written, trimmed; empty for a flag
  };
  std::string name;   ///< upper case without blanks: "SOLIDSECTION"
  std::string shown;  ///< for messages: "*SOLID SECTION"
  std::vector<Parameter> parameters;
  FeSource at;

  bool has(std::string_view parameter) const noexcept;
  /// Value of a parameter; empty if it is not there.
  std::string_view value(std::string_view parameter) const noexcept;
};

/// A name as Abaqus compares it: upper case without blanks, or between quotes as it is.
std::string abaqus_name(std::string_view text);

class AbaqusLines {
 public:
  explicit AbaqusLines(TextSource& source) : source_(source) {}

  /// The next keyword line; data lines before it are skipped. False at the end of the deck.
  bool next_keyword(AbaqusKeyword& keyword);
  /// The next data line of the present keyword, trimmed; false if there are no more.
  bool next_data(std::string_view& line);
  /// Fields of the next data line, without the empty one after a comma at the end of the line.
  bool next_fields(std::vector<std::string_view>& fields);
  void skip_data();
  /// An error if the last data line has more than `count` fields, or another one follows it.
  void no_more(const AbaqusKeyword& keyword, const std::vector<std::string_view>& fields,
               std::size_t count);

  /// The value of a parameter ("REF NODE") that must be there; an error and empty if it is not.
  std::string_view required(const AbaqusKeyword& keyword, std::string_view parameter);
  /// An error for each parameter that is not among those known.
  void allow_only(const AbaqusKeyword& keyword, std::initializer_list<std::string_view> known);
  /// Data lines come from the file of the parameter INPUT, if it is there.
  void take_input(const AbaqusKeyword& keyword);
  /// A real field of the last data line; an error that begins with `what` if it is none.
  double real(std::string_view field, std::string_view what);
  /// The same; an empty or missing field is `otherwise`.
  double real_or(const std::vector<std::string_view>& fields, std::size_t index, double otherwise,
                 std::string_view what);
  int integer(std::string_view field, std::string_view what);

  /// Is there an error in what was read since the last keyword or fields of a line?
  bool misread() const noexcept { return source_.errors() != errors_before_; }

  TextSource& source() noexcept { return source_; }
  /// An error at a keyword: "*SOLID SECTION " + text.
  void error(ErrorCode code, const AbaqusKeyword& keyword, std::string_view text);
  template <class First, class... Rest>
  void error(ErrorCode code, const AbaqusKeyword& keyword, fmt::format_string<First, Rest...> text,
             First&& first, Rest&&... rest) {
    error(code, keyword,
          fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

 private:
  bool next_line(std::string_view& line);
  void parse_keyword(std::string_view line, AbaqusKeyword& keyword);

  TextSource& source_;
  std::size_t errors_before_ = 0;
};

}  // namespace floatframe
