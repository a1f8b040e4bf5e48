#pragma once
// Tables of reference values as text with commas, the names of the columns in the first line.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace floatframe::test {

/// A row by the names of the columns: words as they stand, numbers by `number`.
struct ReferenceRow {
  std::map<std::string, std::string> cells;
  const std::string& word(const std::string& column) const { return cells.at(column); }
  double number(const std::string& column) const { return std::stod(cells.at(column)); }
  bool has(const std::string& column) const {
    const auto cell = cells.find(column);
    return cell != cells.end() && !cell->second.empty();
  }
};

inline std::vector<std::string> reference_cells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The rows of a file below tests/data; none if it cannot be read.
inline std::vector<ReferenceRow> reference_rows(const std::string& name) {
  std::ifstream in(std::filesystem::path(FLOATFRAME_TEST_DATA) / name);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = reference_cells(line);
  std::vector<ReferenceRow> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = reference_cells(line);
    ReferenceRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i)
      row.cells[names[i]] = cells[i];
  }
  return rows;
}

}  // namespace floatframe::test
