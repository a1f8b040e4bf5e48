#pragma once
// Tables of references whose first column is a name.
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace floatframe::test {

struct NamedRow {
  std::string name;
  std::map<std::string, double> numbers;  ///< by column; empty cells are absent
  double operator()(const std::string& column) const { return numbers.at(column); }
};

/// All rows of tests/data/`file`, or those of one name.
inline std::vector<NamedRow> named_rows(const std::string& file, const std::string& name = "") {
  std::ifstream in(std::string(FLOATFRAME_TEST_DATA) + "/" + file);
  if (!in) throw std::runtime_error("cannot read " + file);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');) all.push_back(cell);
    return all;
  };
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = cells(line);
  std::vector<NamedRow> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells(line);
    if (row.empty() || (!name.empty() && row[0] != name)) continue;
    NamedRow& to = rows.emplace_back();
    to.name = row[0];
    for (std::size_t k = 1; k < row.size(); ++k) {
      char* end = nullptr;
      const double x = std::strtod(row[k].c_str(), &end);
      if (end != row[k].c_str()) to.numbers[columns[k]] = x;
    }
  }
  return rows;
}

}  // namespace floatframe::test
