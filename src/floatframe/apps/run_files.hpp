#pragma once
// The files of one run as they come into being: results and states that grow, checkpoints, and at
// its end the report and the summary. Until then the summary has the status "running", so that a
// reader knows at any time what he has before him.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/apps/run_checkpoint.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/history/states_file.hpp"
#include "floatframe/report/run_report.hpp"

namespace floatframe {

struct RunPaths {
  explicit RunPaths(const std::string& folder);
  std::string folder, results, states, report, summary, checkpoint;
};

struct StateLayout;

class RunFiles {
 public:
  struct Options {
    bool report = true;
    double checkpoint_every = 0.0;  ///< [s]; 0: none
    bool resume = false;
    bool overwrite = false;  ///< an unfinished run, and files of other programs
    RunOrigin origin;        ///< for checkpoints
    RunSummary summary;      ///< of what was asked for, with its duration
    /// What is written before the states, which are kept if it is there.
    std::function<HistoryContent(const StateLayout&)> history;
    const Model* model = nullptr;                       ///< what the view of the report shows
    const SimulationDescription* simulation = nullptr;  ///< how it runs
  };

  /// Takes the folder for itself. Throws InputError if another run has it, if there is nothing to
  /// go on from, or not with this run; if a run there is unfinished and is neither to be resumed
  /// nor overwritten; if a file there is of another program.
  RunFiles(const RunPaths& paths, Options options);

  /// False: results go to a device, at the end.
  bool streams() const noexcept { return streams_; }
  /// True: a run that is to be continued has ended before, with all its files.
  bool complete() const noexcept { return complete_; }
  const RunCheckpoint* resumed() const noexcept { return from_ ? &from_->run : nullptr; }
  bool keeps_states() const noexcept { return streams_ && options_.history; }
  double checkpoint_every() const noexcept { return options_.checkpoint_every; }

  /// As RunOptions::rows, RunOptions::states and RunOptions::checkpoint.
  void take(const std::vector<Column>& columns, std::span<const double> numbers);
  void take_states(const StateLayout& layout, std::span<const double> numbers);
  void keep(const RunCheckpoint& checkpoint);

  /// True: the run could not start, and all in the folder is as it was.
  bool untouched() const noexcept { return untouched_; }
  /// What was there before and still is, as a sentence for the end: of a run that could not start
  /// all is as it was, a completed one that was set aside stays until there is another. Or empty.
  std::string kept_sentence() const;

  /// Writes what is left to be written. What cannot be is said in a sentence each, in the result.
  std::vector<std::string> finish(Report&& report);

  /// Time of the last row [s], if something could not be written on the way.
  std::optional<double> cut_at() const noexcept { return cut_at_; }

 private:
  void begin(const std::vector<Column>& columns);
  template <class Write>
  void watched(const Write& write);
  void remove_remains() const;
  void require_own_files() const;
  void require_no_unfinished_run() const;
  void resume();
  /// The page of the viewer, where the program has it.
  void write_report(Report& report) const;
  void finish_states(const RunSummary& summary, std::vector<std::string>& failed);

  RunPaths paths_;
  Options options_;
  FolderLock lock_;
  bool streams_, complete_ = false;
  /// Of the folder before: a completed run, a checkpoint that is to be overwritten.
  bool holds_completed_ = false, holds_checkpoint_ = false;
  bool untouched_ = false;
  std::optional<CheckpointFile> from_;
  std::optional<ResultsFile> results_;
  std::optional<StatesFile> states_;
  std::optional<double> cut_at_;
};

}  // namespace floatframe
