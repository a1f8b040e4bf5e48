#pragma once
// The result file of a run while it grows (history_blocks.hpp has its layout). What ends the
// program leaves all rows that were appended; a disk that is full leaves whole blocks.
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/growing_file.hpp"
#include "floatframe/history/history_header.hpp"

namespace floatframe {

/// What is written before the first row.
struct HistoryContent {
  HistoryHeader header;
  std::vector<std::string> arrays;  ///< bytes of each that the header lists
};

/// Of this program, for a model file and the folder of the result: both may be moved together.
HistoryOrigin history_origin(const std::string& model_file, const std::string& folder);

class StatesFile {
 public:
  /// In place of a file that is there; `continuable`: positions are asked for. Throws OutputError.
  StatesFile(const std::string& path, const HistoryContent& content, bool continuable);
  /// Continues one, see GrowingFile.
  StatesFile(const std::string& path, const GrowingFile::Position& position, std::size_t columns)
      : columns_(columns), file_(path, position) {}

  /// Whole rows. Throws OutputError; what it has written by then are whole blocks.
  void append(std::span<const double> numbers);
  /// How the run ended; nothing is appended afterwards.
  void finish(const std::string& status, const std::string& message);
  void to_disk() { file_.to_disk(); }
  GrowingFile::Position position() const { return file_.position(); }

 private:
  std::size_t columns_;
  GrowingFile file_;
};

}  // namespace floatframe
