#include "floatframe/io/results_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace floatframe {
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += (c == '\n' || c == '\r') ? ' ' : c;
  }
  return quoted + '"';
}

std::string results_csv(const ResultTable& table) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  const std::size_t columns = table.columns.size();
  for (std::size_t c = 0; c < columns; ++c) {
    const Column& column = table.columns[c];
    const std::string title =
        column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
    fmt::format_to(out, "{}{}", c == 0 ? "" : ",", csv_field(title));
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
