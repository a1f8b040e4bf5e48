#pragma once
// Sampled outputs of a run.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

struct Column {
  std::string name;  ///< "chassis.z"
  std::string unit;  ///< "m"
};

/// Sampled outputs: row-major, one row per sample; column 0 is time.
struct ResultTable {
  std::vector<Column> columns;
  std::vector<double> data;
  std::size_t rows() const { return columns.empty() ? 0 : data.size() / columns.size(); }
  double at(std::size_t row, std::size_t column) const {
    return data[row * columns.size() + column];
  }
  /// Index of a column by its name. Throws InputError if there is none.
  std::size_t column(std::string_view name) const;
};

}  // namespace floatframe
