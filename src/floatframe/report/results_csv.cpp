#include "floatframe/report/results_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "floatframe/core/csv_field.hpp"
#include "floatframe/report/results_file.hpp"

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

ResultsFile::ResultsFile(const std::string& path, const std::vector<Column>& columns,
                         bool continuable)
    : columns_(columns.size()), file_(path, continuable) {
  append_csv_header(text_, columns);
  file_.append(text_);
}

ResultsFile::ResultsFile(const std::string& path, const std::vector<Column>& columns,
                         const Position& position)
    : columns_(columns.size()),
      file_(path, position.file),
      rows_(position.rows),
      last_time_(position.last_time) {}

void ResultsFile::append(std::span<const double> numbers) {
  text_.clear();
  append_csv_rows(text_, columns_, numbers);
  const std::uint64_t before = file_.bytes();
  const auto count = [&] {
    const auto kept = static_cast<std::ptrdiff_t>(file_.bytes() - before);
    const auto rows = std::count(text_.begin(), text_.begin() + kept, '\n');
    if (rows == 0) return;
    rows_ += static_cast<std::uint64_t>(rows);
    last_time_ = numbers[static_cast<std::size_t>(rows - 1) * columns_];
  };
  try {
    file_.append(text_);
  } catch (const OutputError&) {
    count();
    throw;
  }
  count();
}

}  // namespace floatframe
