#pragma once
// Tables of two columns: a list of points [x, f] in the model file, or columns of a CSV file.
#include <string>
#include <vector>

#include "floatframe/math/piecewise_build.hpp"
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

}  // namespace floatframe
