#include "floatframe/apps/source_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

constexpr std::uintmax_t largest_source = 64U << 20;
constexpr std::size_t longest_source_line = 100'000;

/// The line of a text file without its end; empty if there is none.
std::string line_of(const SourceMark& mark) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(mark.file, error) || error) return {};
  if (std::filesystem::file_size(mark.file, error) > largest_source || error) return {};
  std::ifstream in(mark.file, std::ios::binary);
  std::string line;
  for (int k = 0; k < mark.line; ++k)
    if (!std::getline(in, line)) return {};
  if (line.ends_with('\r')) line.pop_back();
  const bool is_text = line.find('\0') == std::string::npos && line.size() <= longest_source_line;
  return is_text ? line : std::string();
}

/// One entry for each column on the screen, and which of them shows the byte `at` of the line.
std::vector<std::string> columns_of(const std::string& line, std::size_t at, std::size_t& caret) {
  constexpr std::size_t tab = 8;
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < line.size();) {
    if (k <= at) caret = columns.size();
    const std::size_t bytes = utf8_length(line, k);
    if (line[k] == '\t')
      columns.resize((columns.size() / tab + 1) * tab, " ");
    else
      columns.push_back(bytes == 0 || is_control(line, k) ? "?" : line.substr(k, bytes));
    k += std::max<std::size_t>(bytes, 1);
  }
  if (at >= line.size()) caret = columns.size();
  return columns;
}

}  // namespace

std::string source_line(const SourceMark& mark, std::size_t width) {
  if (mark.line <= 0 || mark.column <= 0 || mark.file.empty()) return {};
  const std::string line = line_of(mark);
  std::size_t caret = 0;
  const std::vector<std::string> columns =
      columns_of(line, static_cast<std::size_t>(mark.column) - 1, caret);
  if (line.find_first_not_of(" \t") == std::string::npos) return {};
  const std::string number = fmt::format("{:>5} | ", mark.line);
  const std::size_t room = width > number.size() + 20 ? width - number.size() : 20;
  // Two thirds of what is shown of a long line stand before the place.
  const std::size_t first = columns.size() <= room || caret < 2 * room / 3
                                ? 0
                                : std::min(caret - 2 * room / 3, columns.size() - room);
  const std::size_t end = std::min(columns.size(), first + room);
  std::string shown;
  for (std::size_t k = first; k < end; ++k) {
    const bool cut = (k == first && first > 0) || (k + 1 == end && end < columns.size());
    shown += cut ? "…" : columns[k];
  }
  return fmt::format("{}{}\n{:>{}} | {:>{}}\n", number, shown, "", number.size() - 3, "^",
                     caret - first + 1);
}

}  // namespace floatframe
