#include "floatframe/formats/text/fortran_columns.hpp"

#include <algorithm>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Widths and counts beyond this are no format.
constexpr int widest = 1000;

std::optional<int> leading_number(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && text[n] >= '0' && text[n] <= '9') ++n;
  const auto value = parse_integer(text.substr(0, n));
  text.remove_prefix(n);
  return value;
}

}  // namespace

std::size_t FortranColumns::integers() const noexcept {
  std::size_t n = 0;
  while (n < columns.size() && columns[n].first == 'i') ++n;
  return n;
}

std::string_view FortranColumns::split(std::string_view line,
                                       std::vector<std::string_view>& cells) const {
  cells.clear();
  for (const auto& [kind, width] : columns) {
    if (line.empty()) break;
    cells.push_back(trimmed(line.substr(0, width)));
    line.remove_prefix(std::min<std::size_t>(width, line.size()));
  }
  return trimmed(line);
}

std::optional<FortranColumns> parse_fortran_columns(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') return std::nullopt;
  std::vector<std::string_view> items;
  split_commas(text.substr(1, text.size() - 2), items);
  FortranColumns result;
  for (std::string_view item : items) {
    auto count = leading_number(item);
    if (!item.empty() && (item[0] == 'P' || item[0] == 'p')) {  // a scale factor
      item = trimmed(item.substr(1));
      if (item.empty()) continue;
      count = leading_number(item);
    }
    if (item.empty() || count.value_or(1) < 1 || count.value_or(1) > widest) return std::nullopt;
    const char kind = lower_case(item.substr(0, 1))[0];
    item.remove_prefix(1);
    const auto width = leading_number(item);  // what follows it are decimals
    if (std::string_view("iadefg").find(kind) == std::string_view::npos || !width || *width < 1 ||
        *width > widest || result.columns.size() > static_cast<std::size_t>(widest))
      return std::nullopt;
    result.columns.insert(result.columns.end(), count.value_or(1), {kind, *width});
  }
  if (result.columns.empty()) return std::nullopt;
  return result;
}

}  // namespace floatframe
