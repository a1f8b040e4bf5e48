#include "floatframe/results/results_file.hpp"

#include <algorithm>

#include "floatframe/results/results_csv.hpp"

namespace floatframe {

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
