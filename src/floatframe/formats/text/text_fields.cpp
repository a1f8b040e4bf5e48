#include "floatframe/formats/text/text_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "floatframe/core/printable.hpp"
#include "floatframe/core/utf8_text.hpp"

namespace floatframe {
namespace {

char upper(char c) noexcept { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }
bool digit(char c) noexcept { return c >= '0' && c <= '9'; }

enum class Number { good, none, too_large };

/// The usual notation. A number too small for double precision is zero.
Number parse_plain(const char* begin, const char* end, double& value) {
  const auto [last, error] = std::from_chars(begin, end, value);
  if (last != end) return Number::none;
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(begin, end).c_str(), nullptr);
    return std::isfinite(value) ? Number::good : Number::too_large;
  }
  return error == std::errc() && std::isfinite(value) ? Number::good : Number::none;
}

/// With D for E, or without E: "1d5", "3.+5".
Number parse_fortran(std::string_view field, double& value) {
  std::string text;
  text.reserve(field.size() + 1);
  bool exponent = false, digits = false;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char c = field[i];
    if (digit(c) || c == '.') {
      digits = digits || digit(c);
      text += c;
      continue;
    }
    const bool sign = c == '+' || c == '-', letter = upper(c) == 'D' || upper(c) == 'E';
    if (!sign && !letter) return Number::none;
    if (sign && i == 0) {
      if (c == '-') text += c;
      continue;
    }
    if (exponent || !digits) return Number::none;
    exponent = true;
    text += 'e';
    if (letter && i + 1 < field.size() && (field[i + 1] == '+' || field[i + 1] == '-')) ++i;
    if (field[i] == '-') text += '-';
  }
  return digits ? parse_plain(text.data(), text.data() + text.size(), value) : Number::none;
}

Number parse(std::string_view field, double& value) {
  field = trimmed(field);
  if (field.empty()) return Number::none;
  const Number plain = parse_plain(field.data(), field.data() + field.size(), value);
  return plain == Number::none ? parse_fortran(field, value) : plain;
}

}  // namespace

std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), upper);
  return result;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char x, char y) { return upper(x) == upper(y); });
}

bool begins_with(std::string_view text, std::string_view head) noexcept {
  return same_word(text.substr(0, head.size()), head);
}

void split_commas(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

void split_blanks(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const auto between = [](char c) { return blank(c) || c == ','; };
  const char* at = line.data();
  const char* const end = at + line.size();
  for (;;) {
    while (at != end && between(*at)) ++at;
    if (at == end) return;
    const char* const begin = at;
    while (at != end && !between(*at)) ++at;
    fields.emplace_back(begin, at - begin);
  }
}

std::string_view next_line(std::string_view& rest) noexcept {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

std::string_view next_word(std::string_view& rest) noexcept {
  std::size_t begin = 0;
  while (begin < rest.size() && blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

bool has_word(std::string_view words, std::string_view word) noexcept {
  for (std::string_view w = next_word(words); !w.empty(); w = next_word(words))
    if (w == word) return true;
  return false;
}

std::optional<double> parse_real(std::string_view field) {
  double value = 0.0;
  if (parse(field, value) != Number::good) return std::nullopt;
  return value;
}

std::optional<int> parse_integer(std::string_view field) noexcept {
  field = trimmed(field);
  if (field.size() > 1 && field.front() == '+' && digit(field[1])) field.remove_prefix(1);
  int value = 0;
  const auto [last, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (field.empty() || error != std::errc() || last != field.data() + field.size())
    return std::nullopt;
  return value;
}

std::optional<int> parse_label(std::string_view field) noexcept {
  const std::optional<int> value = parse_integer(field);
  return value && *value > 0 ? value : std::nullopt;
}

std::string not_a_real(std::string_view field) {
  field = trimmed(field);
  double value = 0.0;
  if (field.empty()) return "a number is missing";
  if (parse(field, value) == Number::too_large) return shown(field) + " is too large";
  return shown(field) + " is not a number";
}

std::string not_an_integer(std::string_view field) {
  field = trimmed(field);
  if (field.empty()) return "a number is missing";
  const std::string_view digits = field.substr(field.front() == '-' || field.front() == '+');
  if (!digits.empty() && std::all_of(digits.begin(), digits.end(), digit))
    return parse_integer(field) ? shown(field) + " is not positive"
                                : shown(field) + " is too large";
  return shown(field) + " is not a whole number";
}

std::string shown(std::string_view field) {
  constexpr std::size_t most = 40, bytes = 4 * most;
  const std::string whole = message_text(field.substr(0, bytes));
  std::string text = "'";
  std::size_t at = 0;
  for (std::size_t count = 0; count < most && at < whole.size(); ++count) {
    const std::size_t length = utf8_length(whole, at);
    text += is_control(whole, at) ? "?" : whole.substr(at, length);
    at += length;
  }
  if (at < whole.size() || field.size() > bytes) text += "...";
  return text + "'";
}

std::string message_text(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, at), 1);
    out += utf8_text(text.substr(at, length));
    at += length;
  }
  return out;
}

}  // namespace floatframe
