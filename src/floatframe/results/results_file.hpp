#pragma once
// `results.csv` while it grows: the bytes of `results_csv`, written row by row. Rows that were
// written are not kept in memory.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/growing_file.hpp"
#include "floatframe/run/result_table.hpp"

namespace floatframe {

class ResultsFile {
 public:
  struct Position {
    GrowingFile::Position file;
    std::uint64_t rows = 0;
    double last_time = 0.0;  ///< of the last row [s]
  };

  /// Replaces an existing file; `continuable`: positions are used. Throws OutputError.
  ResultsFile(const std::string& path, const std::vector<Column>& columns, bool continuable);
  /// Continues a file, see GrowingFile.
  ResultsFile(const std::string& path, const std::vector<Column>& columns,
              const Position& position);

  /// Whole rows. Throws OutputError; `rows` counts the rows written.
  void append(std::span<const double> numbers);
  void to_disk() { file_.to_disk(); }

  std::uint64_t rows() const noexcept { return rows_; }
  double last_time() const noexcept { return last_time_; }
  Position position() const { return {file_.position(), rows_, last_time_}; }

 private:
  std::size_t columns_;
  GrowingFile file_;
  std::uint64_t rows_ = 0;
  double last_time_ = 0.0;
  std::string text_;  ///< of the rows being written
};

}  // namespace floatframe
