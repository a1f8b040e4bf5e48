#include "floatframe/core/number_rule.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace floatframe {

std::string NumberRule::expectation() const {
  return std::string(what) + (*unit ? " [" + std::string(unit) + "]" : "");
}

bool NumberRule::holds(double x) const {
  return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::optional<std::string> NumberRule::complaint(double x) const {
  const bool finite = std::isfinite(x);
  if (finite && holds(x)) return std::nullopt;
  return "found " + number_text(x) + ", expected " + expectation() +
         (finite ? "" : " (numbers must be finite)");
}

std::string WholeNumberRule::expectation() const {
  return std::string(what) + " (a whole number from " + std::to_string(low) + " to " +
         std::to_string(high) + ")";
}

bool WholeNumberRule::holds(double x) const { return std::round(x) == x && x >= low && x <= high; }

std::optional<std::string> WholeNumberRule::complaint(int x) const {
  if (holds(x)) return std::nullopt;
  return "found " + std::to_string(x) + ", expected " + expectation();
}

std::string alternatives(std::span<const char* const> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::optional<std::string> word_complaint(int value, std::span<const char* const> words) {
  if (value >= 0 && static_cast<std::size_t>(value) < words.size()) return std::nullopt;
  return "found " + std::to_string(value) + ", expected " + alternatives(words);
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto r =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0.0 ? 0.0 : value);
  return std::string(buffer.data(), r.ptr);
}

bool is_identifier(std::string_view name, bool hyphen) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  if (name.empty() || !is_letter(name[0])) return false;
  return std::all_of(name.begin(), name.end(), [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || (hyphen && c == '-');
  });
}

}  // namespace floatframe
