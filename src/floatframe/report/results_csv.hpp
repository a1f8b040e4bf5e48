#pragma once
// Results as comma-separated values (RFC 4180): one header line `time [s],chassis.z [m],...`, then
// one line per sample. SI units, angles in radians, 17 significant digits, so that every number
// reads back to the same bits.
// ResultsFile writes these bytes as the rows come: what was written is never held in memory.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/growing_file.hpp"
#include "floatframe/simulation/result_table.hpp"

namespace floatframe {

std::string results_csv(const ResultTable& table);

/// The header line, nothing without columns.
void append_csv_header(std::string& text, const std::vector<Column>& columns);
/// One line for every `columns` numbers.
void append_csv_rows(std::string& text, std::size_t columns, std::span<const double> numbers);

class ResultsFile {
 public:
  struct Position {
    GrowingFile::Position file;
    std::uint64_t rows = 0;
    double last_time = 0.0;  ///< of the last row [s]
  };

  /// In place of a file that is there; `continuable`: positions are asked for. Throws OutputError.
  ResultsFile(const std::string& path, const std::vector<Column>& columns, bool continuable);
  /// Continues one, see GrowingFile.
  ResultsFile(const std::string& path, const std::vector<Column>& columns,
              const Position& position);

  /// Whole rows. Throws OutputError; `rows` counts what was kept.
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
  std::string text_;  ///< of the rows that are being written
};

}  // namespace floatframe
