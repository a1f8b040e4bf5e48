#pragma once
// Tables of two columns: a list of points [x, f] in the model file, or columns of a CSV file.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/yaml/yaml_value.hpp"

namespace floatframe {

struct TableRow {
  TablePoint point;
  int line = 0, column = 0;
  std::size_t number = 0;  ///< from 1
};

/// The rows of a table with their locations, for error messages.
struct TableRows {
  bool good = false;  ///< no errors so far
  std::string file, path;
  std::vector<TableRow> rows;
  ReadErrors* errors = nullptr;
  void error(ErrorCode code, const TableRow& row, const std::string& sentence) const;
};

/// Reads a list of points, or a CSV file (csv_file.hpp), relative to the present file: its name if
/// it has two columns, or {file, column, <argument>, scale, offset, <argument>_scale, decimal} with
/// columns by name or number from 1. The values are scale times those of the file plus offset.
/// `point` describes a point for messages ("a point [x, f]"); `argument`: "x" or "time".
TableRows read_table_rows(const YamlValue& value, const NumberRule& rule, const char* point,
                          const char* argument = "x");

/// Rows of as many numbers as there are columns: a list of them, or a CSV file, relative to the
/// present file: its name if it has these columns alone, in this order, or {file, columns, decimal}
/// with the columns by names or numbers from 1. nullopt after an error; at least one row.
std::optional<MatX> read_number_rows(const YamlValue& value, std::span<const char* const> columns,
                                     const NumberRule& rule);

}  // namespace floatframe
