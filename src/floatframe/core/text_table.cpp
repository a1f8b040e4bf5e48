#include "floatframe/core/text_table.hpp"

#include <algorithm>

#include "floatframe/core/table_width.hpp"

namespace floatframe {
namespace {

std::size_t width_of(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

using Columns = std::vector<std::size_t>;

/// All columns, or if they do not fit as many blocks as it takes, each begun by the first column,
/// which says what a row is.
std::vector<Columns> blocks_of(const std::vector<std::size_t>& widths, std::size_t indent) {
  const std::size_t most = detail::table_width;
  std::vector<Columns> blocks(1);
  std::size_t used = 0;
  for (std::size_t c = 0; c < widths.size(); ++c) {
    if (most > 0 && blocks.back().size() > 1 && used + 2 + widths[c] > most) {
      blocks.push_back({0});
      used = indent + widths[0];
    }
    used += c == 0 ? indent + widths[c] : 2 + widths[c];
    blocks.back().push_back(c);
  }
  return blocks;
}

}  // namespace

TextTable::TextTable(std::vector<std::string> header, std::vector<std::size_t> left)
    : left_(std::move(left)) {
  left_.push_back(0);
  rows_.push_back(std::move(header));
}

void TextTable::add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

std::string TextTable::text(std::size_t indent) const {
  std::vector<std::size_t> widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], width_of(row[c]));
    }
  }
  std::string out;
  for (const Columns& columns : blocks_of(widths, indent)) {
    if (!out.empty()) out += '\n';
    for (const auto& row : rows_) {
      std::string line(indent, ' ');
      for (const std::size_t c : columns) {
        if (c >= row.size()) continue;
        const std::string blanks(widths[c] - width_of(row[c]), ' ');
        const bool to_left = std::find(left_.begin(), left_.end(), c) != left_.end();
        line += (c == columns.front() ? "" : "  ") + (to_left ? row[c] + blanks : blanks + row[c]);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + '\n';
    }
  }
  return out;
}

}  // namespace floatframe
