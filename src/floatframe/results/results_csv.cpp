#include "floatframe/results/results_csv.hpp"

#include <fmt/format.h>

#include <iterator>

#include "floatframe/core/csv_field.hpp"

namespace floatframe {

void append_csv_header(std::string& text, const std::vector<Column>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c > 0) text += ',';
    text += csv_title(columns[c].name, columns[c].unit);
  }
  if (!columns.empty()) text += '\n';
}

void append_csv_rows(std::string& text, std::size_t columns, std::span<const double> numbers) {
  fmt::basic_memory_buffer<char, 4096> row;
  for (std::size_t k = 0; k + columns <= numbers.size() && columns > 0; k += columns) {
    row.clear();
    for (std::size_t c = 0; c < columns; ++c) {
      if (c > 0) row.push_back(',');
      fmt::format_to(std::back_inserter(row), "{:.17g}", numbers[k + c]);
    }
    row.push_back('\n');
    text.append(row.data(), row.size());
  }
}

std::string results_csv(const ResultTable& table) {
  std::string text;
  append_csv_header(text, table.columns);
  append_csv_rows(text, table.columns.size(), table.data);
  return text;
}

}  // namespace floatframe
