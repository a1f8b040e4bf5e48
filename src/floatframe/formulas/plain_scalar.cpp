// Interpretation of plain scalars.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "floatframe/core/ascii.hpp"
#include "floatframe/formulas/syntax_tree.hpp"

namespace floatframe {
PlainScalar classify_plain_scalar(std::string_view text) {
  using Kind = PlainScalar::Kind;
  const auto bad = [](Kind kind, const char* complaint) {
    return PlainScalar{kind, false, 0.0, complaint};
  };
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL")
    return {Kind::null};
  if (text == "true" || text == "false") return {Kind::boolean, text == "true"};
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const char* word : {"true", "yes", "on", "false", "no", "off"}) {
    if (lower != word) continue;
    const bool truth = lower == "true" || lower == "yes" || lower == "on";
    return bad(Kind::bad_boolean, truth ? "write true" : "write false");
  }
  std::string_view body = lower;
  if (body[0] == '+' || body[0] == '-') body.remove_prefix(1);
  if (body == ".inf" || body == ".nan" || body == "inf" || body == "nan" || body == "infinity")
    return bad(Kind::bad_number, "numbers must be finite");
  if (body.empty() ||
      !(is_digit(body[0]) || (body[0] == '.' && body.size() > 1 && is_digit(body[1]))))
    return {Kind::text};
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
    return other_base || body.find('_') != std::string_view::npos
               ? bad(Kind::bad_number, "write a decimal number")
               : PlainScalar{Kind::text};
  }
  if (whole > 1 && body[0] == '0') return bad(Kind::bad_number, "a number must not start with 0");
  double number = 0.0;
  const auto r = std::from_chars(body.data(), body.data() + body.size(), number);
  const bool tiny =
      r.ec == std::errc::result_out_of_range && body.find("e-") != std::string_view::npos;
  if (tiny) number = 0.0;
  if (!tiny && (r.ec != std::errc() || !std::isfinite(number)))
    return bad(Kind::bad_number, "numbers must be finite");
  return {Kind::number, false, lower[0] == '-' ? -number : number};
}

}  // namespace floatframe
