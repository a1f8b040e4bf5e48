#include "floatframe/report/results_csv.hpp"

#include <fmt/format.h>

#include <iterator>

#include "floatframe/core/csv_field.hpp"

namespace floatframe {

std::string results_csv(const ResultTable& table) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  const std::size_t columns = table.columns.size();
  for (std::size_t c = 0; c < columns; ++c) {
    const Column& column = table.columns[c];
    fmt::format_to(out, "{}{}", c == 0 ? "" : ",", csv_title(column.name, column.unit));
  }
  if (columns > 0) text.push_back('\n');
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < columns; ++c) {
      if (c > 0) text.push_back(',');
      fmt::format_to(out, "{:.17g}", table.at(row, c));
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace floatframe
