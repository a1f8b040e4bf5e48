#pragma once
// CSV files of numbers, as measuring programs and spreadsheets write them: columns separated by
// semicolons, commas or blanks, an optional line of names and one of units, comments after #.
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace floatframe {

/// `automatic`: a comma between digits is a decimal comma where commas do not separate the columns.
enum class DecimalSign { automatic, point, comma };

struct CsvFile {
  std::string text;
  std::vector<std::string> names;  ///< none without a line of names
  std::size_t columns = 0;         ///< of the first row
  std::vector<double> numbers;     ///< row by row; NaN where there is no number
  std::vector<int> lines;          ///< of the rows, from 1
  /// The first row with another number of columns, and that number; rows end before it. 0: none.
  int uneven_line = 0;
  std::size_t uneven = 0;
  bool commas = false, points = false;  ///< in numbers

  std::size_t rows() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return numbers[row * columns + column]; }
  /// As it is written.
  std::string cell(std::size_t row, std::size_t column) const;
  /// From 0, of one name or, if none has it, of one name without its unit in brackets.
  std::vector<std::size_t> columns_of(const std::string& name) const;

  std::vector<std::size_t> starts;  ///< of the rows in the text
  char separator = ' ';
};

CsvFile parse_csv(std::string text, DecimalSign sign);

/// The files of one reading, parsed once each.
using CsvFiles = std::map<std::pair<std::string, DecimalSign>, std::shared_ptr<const CsvFile>>;

}  // namespace floatframe
