#include "floatframe/core/text_pieces.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace floatframe {

std::vector<std::string> pieces_of(const std::string& text, char at) {
  std::vector<std::string> out{""};
  for (const char c : text)
    if (c == at)
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

std::optional<double> finite_number(const std::string& text) {
  std::string_view number = text;
  number.remove_prefix(std::min(number.find_first_not_of(' '), number.size()));
  if (number.size() > 1 && number[0] == '+' && number[1] != '-') number.remove_prefix(1);
  double x = 0.0;
  const char* const end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, x);
  return error != std::errc() || rest != end || !std::isfinite(x) ? std::nullopt : std::optional(x);
}

std::string names_text(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = std::min(most, names.size());
  std::string text;
  for (std::size_t k = 0; k < shown; ++k) text += (k > 0 ? ", " : "") + names[k];
  if (names.size() > shown) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

}  // namespace floatframe
