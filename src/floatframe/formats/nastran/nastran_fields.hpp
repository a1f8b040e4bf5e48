#pragma once
// Fields of one Nastran card as numbers, with errors that name the card and the expected value.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Identification of a card: its name, its number and its location.
struct NastranEntity {
  std::string card;
  int id = 0;
  FeSource at;
  /// "CTETRA 12", for messages.
  std::string label() const { return fmt::format("{} {}", card, id); }
};

/// Whole numbers where real ones are expected: Nastran stops there.
struct NastranWholeNumbers {
  int count = 0;
  std::string first;  ///< "GRID 3: a coordinate is '3'"
  FeSource at;
};

/// Allowed range of a real number.
enum class NastranRange { any, positive, not_negative };

class NastranFields {
 public:
  NastranFields(TextSource& source, const NastranCard& card, NastranWholeNumbers* whole = nullptr)
      : source_(source), card_(card), whole_(whole) {}

  bool blank(std::size_t i) const { return card_.field(i).empty(); }
  std::size_t size() const { return card_.fields.size(); }
  std::string_view text(std::size_t i) const { return card_.field(i); }
  FeSource at() const { return card_.at; }
  const std::string& name() const { return card_.name; }

  /// Identification of a card with its number in a field; `what`: "the number of the element".
  template <class Entity>
  Entity entity(const char* what, std::size_t i = 0) {
    Entity e;
    e.card = card_.name;
    e.at = card_.at;
    e.id = label(i, what);
    return e;
  }
  /// Keeps it by its number; an error if that is there already.
  template <class Entity>
  void keep(std::map<int, Entity>& all, Entity entity) {
    const int id = entity.id;
    const auto [it, fresh] = all.try_emplace(id, std::move(entity));
    if (!fresh && id > 0) twice(it->second.at);
  }
  /// Reports a duplicate number.
  void twice(const FeSource& first) {
    error(ErrorCode::duplicate, "this number is in the file twice, first in line {}", first.line);
  }

  /// A number that names something; 0 with an error if it is none.
  int label(std::size_t i, const char* what);
  int label(std::size_t i, const char* what, int otherwise) {
    return blank(i) ? otherwise : label(i, what);
  }
  /// A number, or "FIRST THRU LAST", whose last field `i` then is; the numbers are 0 with an error.
  std::pair<int, int> range(std::size_t& i, const char* what);
  int integer(std::size_t i, const char* what, int otherwise);
  /// Must be there, unless there is a value otherwise.
  double real(std::size_t i, const char* what, std::optional<double> otherwise = {},
              NastranRange range = NastranRange::any);
  std::optional<double> real_if_given(std::size_t i, const char* what) {
    return blank(i) ? std::optional<double>{} : real(i, what);
  }
  Vec3 vector(std::size_t i, const char* what);  ///< three fields, blank: 0
  /// Components such as "123456"; 0 and blank: none.
  unsigned components(std::size_t i, const char* what);
  /// Index of one of them from 0, 6 with an error; if it is optional and missing: -1.
  int component(std::size_t i, bool needed);

  /// Errors of the file so far.
  std::size_t errors() const { return source_.errors(); }
  /// "CTETRA 12: ..." at the card, or at the line of a field.
  template <class... Values>
  void error(ErrorCode code, fmt::format_string<Values...> text, Values&&... values) {
    error_at(code, card_.at, fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void error_in(ErrorCode code, std::size_t field, fmt::format_string<Values...> text,
                Values&&... values) {
    error_at(code, card_.place(field), fmt::format(text, std::forward<Values>(values)...));
  }
  /// Error if the field is neither blank nor zero.
  void must_be_zero(std::size_t i, const char* what);

 private:
  void error_at(ErrorCode code, const FeSource& at, const std::string& message);
  /// "CTETRA 12", or the name alone if there is no number.
  std::string card_label() const;

  TextSource& source_;
  const NastranCard& card_;
  NastranWholeNumbers* whole_;
};

}  // namespace floatframe
