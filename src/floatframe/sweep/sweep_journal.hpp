#pragma once
// The memory of a study that may be interrupted at any moment: a text file to which one line is
// added for every finished run. A line is "<fingerprint of the rest> <JSON>\n"; one that was torn
// by a crash does not match its fingerprint and is left out, so its run is repeated. The first line
// tells what the study is; a journal of another study is refused.
//
// A line is handed to the system at once, which is safe against the end of the process in any way;
// against a loss of power the file is flushed to the disk at most every half second.
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/sweep/sweep_row.hpp"

namespace floatframe {

/// What must be the same for a study to be continued: (what it is in words, its value), in the
/// order in which a difference is reported. Files, which must not change either, are apart: a run
/// whose reading was stopped may come to know one later.
using SweepIdentity = std::vector<std::pair<std::string, std::string>>;

/// A row as one line of text and back. `decode` returns false for anything that is not whole.
std::string encode_row(std::size_t run, const SweepRow& row);
bool decode_row(const std::string& text, std::size_t& run, SweepRow& row);

class SweepJournal {
 public:
  using Files = std::map<std::string, std::string>;

  /// Opens or creates the journal at `path` for a study of `runs` runs and takes it for this
  /// process. Throws InputError if it belongs to another study or another process is at it,
  /// OutputError if it cannot be written. `fresh`: what is there is given up. `files`: fingerprints
  /// of the contents of files by name.
  SweepJournal(const std::string& path, const SweepIdentity& identity, std::size_t runs, bool fresh,
               const Files& files = {});
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  /// Runs finished so far, by number from 0.
  const std::map<std::size_t, SweepRow>& finished() const noexcept { return finished_; }

  /// Adds a finished run given by its line from `encode_row`. Throws OutputError.
  void add(const std::string& line);
  /// Takes failed runs as not finished; the line of their repetition counts.
  void forget_failed();
  /// To the disk.
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
  Files files_;  ///< known to the journal
};

}  // namespace floatframe
