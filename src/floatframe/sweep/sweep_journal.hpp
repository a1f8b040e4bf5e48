#pragma once
// Journal of a study that may be interrupted at any moment: a text file with one line per finished
// run. A line is "<fingerprint of the rest> <JSON>\n"; a line cut short by a crash does not match
// its fingerprint and is ignored, so its run is repeated. The first line identifies the study; a
// journal of another study is rejected.
//
// A line is written to the system at once, so that it survives any end of the process; against
// power failures the file is flushed to the disk at most every half second.
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/sweep/sweep_row.hpp"

namespace floatframe {

/// Must be equal for a study to be continued: (description, value) in the order in which
/// differences are reported. Files, which must not change either, are separate: an interrupted
/// reading may add one later.
using SweepIdentity = std::vector<std::pair<std::string, std::string>>;

/// A row as one line of text and back. `decode` returns false for an incomplete line.
std::string encode_row(std::size_t run, const SweepRow& row);
bool decode_row(const std::string& text, std::size_t& run, SweepRow& row);

class SweepJournal {
 public:
  using Files = std::map<std::string, std::string>;

  /// Opens or creates the journal at `path` for a study of `runs` runs and locks it. Throws
  /// InputError if it belongs to another study or another process uses it, OutputError if it cannot
  /// be written. `fresh`: discards existing content. `files`: fingerprints of the contents of files
  /// by name.
  SweepJournal(const std::string& path, const SweepIdentity& identity, std::size_t runs, bool fresh,
               const Files& files = {});
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  /// Runs finished so far, by number from 0.
  const std::map<std::size_t, SweepRow>& finished() const noexcept { return finished_; }

  /// Adds a finished run given by its line from `encode_row`. Throws OutputError.
  void add(const std::string& line);
  /// Treats failed runs as not finished; the line of their repetition counts.
  void forget_failed();
  /// Flushes to the disk.
  void flush();

 private:
  void create(const std::string& header);
  void load(const std::string& header, const SweepIdentity& identity, std::size_t runs);
  void load_line(const std::string& line, std::size_t runs);
  void agree_on_files(const Files& files);
  void write(const std::string& line);

  std::string path_;
  int file_ = -1;
  bool unflushed_ = false;
  std::chrono::steady_clock::time_point flushed_;
  std::map<std::size_t, SweepRow> finished_;
  Files files_;  ///< listed in the journal
};

}  // namespace floatframe
