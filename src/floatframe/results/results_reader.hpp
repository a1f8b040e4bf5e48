#pragma once
// `results.csv` read row by row, with memory for one row: files of this program, and others with
// one header line and numbers (RFC 4180: quoted titles, CRLF; blanks around numbers).
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

/// Fills `row` with the numbers of a line. False if their count differs: `column` is the one
/// without a number and `at` its position in the line.
bool read_numbers(const std::string& line, std::vector<double>& row, std::size_t& column,
                  std::size_t& at);

class ResultsReader {
 public:
  /// Reads the header. Throws InputError with the name of the file and the violation: expected are
  /// a regular file, first column `time` (or `time [s]`), distinct titles.
  explicit ResultsReader(const std::string& file);

  const std::string& file() const noexcept { return file_; }
  /// The first is the time. Units are the bracketed ends of titles.
  const std::vector<Column>& columns() const noexcept { return columns_; }

  /// False at the end. Throws InputError at a line that does not have one number per column, or a
  /// time that is not later than the previous one.
  bool next();
  const std::vector<double>& row() const noexcept { return row_; }
  double time() const noexcept { return row_.front(); }
  std::size_t rows() const noexcept { return rows_; }  ///< read so far
  /// The last line is incomplete, as left by a killed run; it is not counted as a row.
  bool torn() const noexcept { return torn_; }

 private:
  struct Close {
    void operator()(std::FILE* f) const noexcept { std::fclose(f); }
  };
  bool read_line();
  void read_header();
  [[noreturn]] void refuse(ErrorCode code, std::size_t at, const std::string& message) const;

  std::string file_, line_;
  std::unique_ptr<std::FILE, Close> in_;
  std::vector<Column> columns_;
  std::vector<double> row_;
  std::size_t rows_ = 0;
  int number_ = 0;      ///< line number
  bool ended_ = false;  ///< the line ends with a line break
  bool torn_ = false;
};

}  // namespace floatframe
