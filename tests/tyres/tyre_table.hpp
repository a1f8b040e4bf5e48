#pragma once
// Tables of reference values of tyres: comma-separated, the first line with the names of columns.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "floatframe/tyres/magic_radius.hpp"

namespace floatframe::test {

inline constexpr double degree = std::numbers::pi / 180.0;

struct TyreTable {
  std::map<std::string, std::size_t> columns;
  std::vector<std::vector<double>> rows;  ///< NaN where a cell is empty or a word

  bool has(const std::string& column) const { return columns.contains(column); }
  double at(std::size_t row, const std::string& column) const {
    return rows[row][columns.at(column)];
  }
  /// Largest size of a value.
  double scale(const std::string& column) const {
    double most = 0.0;
    for (const auto& row : rows) most = std::fmax(most, std::abs(row[columns.at(column)]));
    return most;
  }
};

inline std::string tyre_data(const std::string& name) {
  return std::string(FLOATFRAME_TEST_DATA) + "/tyres/mf/" + name;
}

inline TyreTable tyre_table(const std::string& name) {
  TyreTable table;
  std::ifstream file(tyre_data(name));
  EXPECT_TRUE(file.good()) << name;
  std::string line;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells{""};
    for (const char c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    if (table.columns.empty()) {
      for (std::size_t k = 0; k < cells.size(); ++k) table.columns[cells[k]] = k;
      continue;
    }
    std::vector<double> row;
    for (const std::string& cell : cells) {
      char* end = nullptr;
      const double x = std::strtod(cell.c_str(), &end);
      row.push_back(end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : x);
    }
    table.rows.push_back(row);
  }
  return table;
}

inline MagicTyre magic_tyre_of(const std::string& name, const MagicOptions& options = {}) {
  return magic_tyre(read_tir(tyre_data(name)), options);
}

/// The steady state of a row of the tables mf.
inline MagicInput<double> input_of(const TyreTable& table, std::size_t row) {
  const double V = table.at(row, "Vx_m_s"), kappa = table.at(row, "kappa");
  return {.load = table.at(row, "Fz_N"),
          .kappa = kappa,
          .tan_alpha = std::tan(table.at(row, "alpha_deg") * degree),
          .camber = table.at(row, "gamma_deg") * degree,
          .speed = V,
          .rolling = (1.0 + kappa) * V,
          .friction = 1.0};
}

}  // namespace floatframe::test
