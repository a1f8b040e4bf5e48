// Scalars as they stand in a model file: what a plain one is, how a number is written.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "floatframe/core/ascii.hpp"
#include "floatframe/yaml/expression.hpp"

namespace floatframe {
namespace {}  // namespace

std::string value_text(const ParameterValue& value) {
  if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const double* x = std::get_if<double>(&value)) return number_text(*x);
  return std::get<std::string>(value);
}

const char* type_name(const ParameterValue& value) {
  constexpr std::array names{"true or false", "a number", "a text"};
  return names[value.index()];
}

PlainScalar classify_plain_scalar(std::string_view text) {
  PlainScalar s;
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL") {
    s.kind = PlainScalar::Kind::null;
    return s;
  }
  if (text == "true" || text == "false") {
    s.kind = PlainScalar::Kind::boolean;
    s.boolean = text == "true";
    return s;
  }
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const char* word : {"true", "yes", "on", "false", "no", "off"}) {
    if (lower != word) continue;
    const bool truth = lower == "true" || lower == "yes" || lower == "on";
    s.kind = PlainScalar::Kind::bad_boolean;
    s.complaint = truth ? "write true" : "write false";
    return s;
  }
  std::string_view body = lower;
  if (body[0] == '+' || body[0] == '-') body.remove_prefix(1);
  if (body == ".inf" || body == ".nan" || body == "inf" || body == "nan" || body == "infinity") {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "numbers must be finite";
    return s;
  }
  if (body.empty() ||
      !(is_digit(body[0]) || (body[0] == '.' && body.size() > 1 && is_digit(body[1]))))
    return s;
  // digits [. digits] [e [+-] digits]
  std::size_t k = 0;
  const auto digits = [&] {
    const std::size_t begin = k;
    while (k < body.size() && is_digit(body[k])) ++k;
    return k - begin;
  };
  const std::size_t whole = digits();
  std::size_t fraction = 0;
  if (k < body.size() && body[k] == '.') ++k, fraction = digits();
  bool well_formed = whole + fraction > 0;
  if (well_formed && k < body.size() && body[k] == 'e') {
    ++k;
    if (k < body.size() && (body[k] == '+' || body[k] == '-')) ++k;
    well_formed = digits() > 0;
  }
  if (!well_formed || k != body.size()) {
    const bool other_base =
        body.size() > 2 && body[0] == '0' && (body[1] == 'x' || body[1] == 'o' || body[1] == 'b');
    if (other_base || body.find('_') != std::string_view::npos) {
      s.kind = PlainScalar::Kind::bad_number;
      s.complaint = "write a decimal number";
    }
    return s;
  }
  if (whole > 1 && body[0] == '0') {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "a number must not start with 0";
    return s;
  }
  const auto r = std::from_chars(body.data(), body.data() + body.size(), s.number);
  const bool tiny =
      r.ec == std::errc::result_out_of_range && body.find("e-") != std::string_view::npos;
  if (tiny) s.number = 0.0;
  if (!tiny && (r.ec != std::errc() || !std::isfinite(s.number))) {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "numbers must be finite";
    return s;
  }
  if (lower[0] == '-') s.number = -s.number;
  s.kind = PlainScalar::Kind::number;
  return s;
}

}  // namespace floatframe
