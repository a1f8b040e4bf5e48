#pragma once
// Rules for numbers, whole numbers and words of a description, and the sentence about a violation:
// "found -1, expected a positive number [s]". The readers of files apply these rules to the text,
// `build_model` to descriptions made by C++ programs, so that both give the same messages.
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace floatframe {

/// Rule for a number. `what` completes "expected ...", `unit` is appended in brackets.
struct NumberRule {
  const char* what = "a number";
  const char* unit = "";
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is excluded
  bool high_open = false;  ///< high itself is excluded
  std::string expectation() const;
  bool holds(double x) const;
  /// "found ..., expected ..."; nullopt if x satisfies the rule. NaN and infinity never do.
  std::optional<std::string> complaint(double x) const;
};
inline constexpr NumberRule any_number(const char* unit) { return {"a number", unit}; }
inline constexpr NumberRule positive_number(const char* unit) {
  NumberRule r{"a positive number", unit, 0.0};
  r.low_open = true;
  return r;
}
inline constexpr NumberRule non_negative_number(const char* unit) {
  return {"a number >= 0", unit, 0.0};
}

/// Rule for a whole number.
struct WholeNumberRule {
  const char* what = "a number";
  int low = 0, high = std::numeric_limits<int>::max();
  /// "a number of modes (a whole number from 0 to 100)"
  std::string expectation() const;
  bool holds(double x) const;
  std::optional<std::string> complaint(int x) const;
};

/// "one, two or three"
std::string alternatives(std::span<const char* const> words);
/// The complaint about an enumerator without a word.
std::optional<std::string> word_complaint(int value, std::span<const char* const> words);

/// Number as a user would write it: the shortest digits that read back as the same double.
std::string number_text(double value);

/// Letter or underscore, then letters, digits, underscores; hyphens too if `hyphen`.
bool is_identifier(std::string_view name, bool hyphen = false);

}  // namespace floatframe
