#pragma once
// What numbers, whole numbers and words of a description must be, and the sentence about one that
// is not: "found -1, expected a positive number [s]". The readers of files use these rules on what
// is written, `build_model` on what a C++ program hands over, so that both say the same.
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace floatframe {

/// What a number must be. `what` completes "expected ...", `unit` is appended in brackets.
struct NumberRule {
  const char* what = "a number";
  const char* unit = "";
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is excluded
  bool high_open = false;  ///< high itself is excluded
  std::string expectation() const;
  bool holds(double x) const;
  /// "found ..., expected ..."; nullopt if x is as it must be. Never true of NaN and infinity.
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

/// What a whole number must be.
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
/// The complaint about an enumerator that is none of those the words name.
std::optional<std::string> word_complaint(int value, std::span<const char* const> words);

/// Number as a user would write it: the shortest digits that read back as the same double.
std::string number_text(double value);

/// Letter or underscore, then letters, digits, underscores; hyphens too if `hyphen`.
bool is_identifier(std::string_view name, bool hyphen = false);

}  // namespace floatframe
