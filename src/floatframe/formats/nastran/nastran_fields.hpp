#pragma once
// Fields of one Nastran card as numbers, with errors that name the card and what is expected.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Whole numbers where real ones are expected: Nastran stops there.
struct NastranWholeNumbers {
  int count = 0;
  std::string first;  ///< "GRID 3: a coordinate is '3'"
  FeSource at;
};

class NastranFields {
 public:
  NastranFields(TextSource& source, const NastranCard& card, NastranWholeNumbers* whole = nullptr)
      : source_(source), card_(card), whole_(whole) {}

  bool blank(std::size_t i) const { return card_.field(i).empty(); }
  std::size_t size() const { return card_.fields.size(); }
  std::string_view text(std::size_t i) const { return card_.field(i); }
  FeSource at() const { return card_.at; }
  const std::string& name() const { return card_.name; }

  /// A number that names something; 0 with an error if it is none.
  int label(std::size_t i, const char* what);
  /// A number, or "FIRST THRU LAST", whose last field `i` then is; the numbers are 0 with an error.
  std::pair<int, int> range(std::size_t& i, const char* what);
  int integer(std::size_t i, const char* what, int otherwise);
  double real(std::size_t i, const char* what);  ///< must be there
  double real(std::size_t i, const char* what, double otherwise);
  Vec3 vector(std::size_t i, const char* what);  ///< three fields, blank: 0
  /// Components such as "123456"; 0 and blank: none.
  unsigned components(std::size_t i, const char* what);

  /// Errors of the file so far.
  std::size_t errors() const { return source_.errors(); }
  /// "CTETRA 12: ..." at the card, or at the line of a field.
  void error(ErrorCode code, const std::string& message) { error_at(code, card_.at, message); }
  template <class First, class... Rest>
  void error(ErrorCode code, fmt::format_string<First, Rest...> text, First&& first,
             Rest&&... rest) {
    error(code, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <class First, class... Rest>
  void error_in(ErrorCode code, std::size_t field, fmt::format_string<First, Rest...> text,
                First&& first, Rest&&... rest) {
    error_in(code, field,
             fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  void error_in(ErrorCode code, std::size_t field, const std::string& message) {
    error_at(code, card_.place(field), message);
  }
  /// Error if the field is neither blank nor zero.
  void must_be_zero(std::size_t i, const char* what);

 private:
  void error_at(ErrorCode code, const FeSource& at, const std::string& message);

  TextSource& source_;
  const NastranCard& card_;
  NastranWholeNumbers* whole_;
};

}  // namespace floatframe
