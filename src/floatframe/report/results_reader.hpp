#pragma once
// `results.csv` read back row by row, in the memory of one row: files of this program, and of
// others that write one header line and numbers (RFC 4180: quoted titles, CRLF; blanks around
// numbers).
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/simulation/result_table.hpp"

namespace floatframe {

/// Fills `row` with the numbers of a line. False if it does not hold as many and no more: `column`
/// is the one without a number and `at` where it should stand.
bool read_numbers(const std::string& line, std::vector<double>& row, std::size_t& column,
                  std::size_t& at);

class ResultsReader {
 public:
  /// Reads the header. Throws InputError that names the file and what is not as expected: a regular
  /// file, first column `time` (or `time [s]`), titles that differ from each other.
  explicit ResultsReader(const std::string& file);

  const std::string& file() const noexcept { return file_; }
  /// The first is the time. Units are what stands in brackets at the end of titles.
  const std::vector<Column>& columns() const noexcept { return columns_; }

  /// False at the end. Throws InputError at a line that does not hold a number for each column, or
  /// a time that is not later than the one before.
  bool next();
  const std::vector<double>& row() const noexcept { return row_; }
  double time() const noexcept { return row_.front(); }
  std::size_t rows() const noexcept { return rows_; }  ///< read so far
  /// The last line was begun and never ended, as a run that was killed leaves it; it is no row.
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
  int number_ = 0;      ///< of the line
  bool ended_ = false;  ///< the line has its line break
  bool torn_ = false;
};

}  // namespace floatframe
