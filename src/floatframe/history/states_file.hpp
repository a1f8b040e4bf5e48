#pragma once
// The result file of a run while it grows (history_blocks.hpp has its layout). Any end of the
// program keeps all rows appended before; a full disk leaves whole blocks.
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/growing_file.hpp"
#include "floatframe/history/history_header.hpp"

namespace floatframe {

/// Content written before the first row.
struct HistoryContent {
  HistoryHeader header;
  std::vector<std::string> arrays;  ///< bytes of each array listed in the header
};

/// For this program, a model file and the folder of the result: both may be moved together.
HistoryOrigin history_origin(const std::string& model_file, const std::string& folder);

class StatesFile {
 public:
  /// Replaces an existing file; `continuable`: positions are used. Throws OutputError.
  StatesFile(const std::string& path, const HistoryContent& content, bool continuable);
  /// Continues a file, see GrowingFile.
  StatesFile(const std::string& path, const GrowingFile::Position& position, std::size_t columns)
      : columns_(columns), file_(path, position) {}

  /// Whole rows. Throws OutputError; blocks written before the error are complete.
  void append(std::span<const double> numbers);
  /// Writes how the run ended; nothing may be appended afterwards.
  void finish(const std::string& status, const std::string& message);
  void to_disk() { file_.to_disk(); }
  GrowingFile::Position position() const { return file_.position(); }

 private:
  std::size_t columns_;
  GrowingFile file_;
};

/// The bytes of such a file, complete.
std::string states_bytes(const HistoryContent& content, std::span<const double> rows,
                         const std::string& status, const std::string& message);

}  // namespace floatframe
