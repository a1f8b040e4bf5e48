#pragma once
// The files of one run while it runs: growing results and states, checkpoints, and at the end the
// report and the summary. Until then the summary has the status "running", which tells readers that
// the files are incomplete.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/apps/run_checkpoint.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/history/states_file.hpp"
#include "floatframe/page/run_report.hpp"

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
    bool overwrite = false;  ///< also an unfinished run and files of other programs
    RunOrigin origin;        ///< for checkpoints
    RunSummary summary;      ///< of the requested run, with its duration
    /// Header of the states, which are recorded if this is set.
    std::function<HistoryContent(const StateLayout&)> history;
    const Model* model = nullptr;                       ///< shown in the view of the report
    const SimulationDescription* simulation = nullptr;  ///< options of the run
  };

  /// Locks the folder. Throws InputError if another run has locked it, if there is no checkpoint to
  /// resume or it is of another run, if an unfinished run is to be neither resumed nor overwritten,
  /// or if a file there was written by another program.
  RunFiles(const RunPaths& paths, Options options);

  /// False: results go to a device, at the end of the run.
  bool streams() const noexcept { return streams_; }
  /// True: the run to be resumed has already completed, with all its files.
  bool complete() const noexcept { return complete_; }
  const RunCheckpoint* resumed() const noexcept { return from_ ? &from_->run : nullptr; }
  bool keeps_states() const noexcept { return streams_ && options_.history; }
  double checkpoint_every() const noexcept { return options_.checkpoint_every; }

  /// As RunOptions::rows, RunOptions::states and RunOptions::checkpoint.
  void take(const std::vector<Column>& columns, std::span<const double> numbers);
  void take_states(const StateLayout& layout, std::span<const double> numbers);
  void keep(const RunCheckpoint& checkpoint);

  /// True: the run could not start, and the folder is unchanged.
  bool untouched() const noexcept { return untouched_; }
  /// Sentence at the end about an earlier run that is still there: unchanged if this run could not
  /// start; a completed run that was set aside is kept until another completes. Or empty.
  std::string kept_sentence() const;

  /// Writes all remaining files. Each failure is a sentence in the result.
  std::vector<std::string> finish(Report& report);
  /// Writes report and summary again, after `finish`.
  std::vector<std::string> rewrite(const Report& report);

  /// Time of the last row [s], if writing failed during the run.
  std::optional<double> cut_at() const noexcept { return cut_at_; }

 private:
  void begin(const std::vector<Column>& columns);
  template <class Write>
  void watched(const Write& write);
  void remove_remains() const;
  void require_own_files() const;
  void require_no_unfinished_run() const;
  void resume();
  /// The page of the viewer, if the program contains the viewer.
  void write_report(const Report& report) const;
  void finish_states(const RunSummary& summary, std::vector<std::string>& failed);

  RunPaths paths_;
  Options options_;
  FolderLock lock_;
  bool streams_, complete_ = false;
  /// Previous content of the folder: a completed run, a checkpoint that is to be overwritten.
  bool holds_completed_ = false, holds_checkpoint_ = false;
  bool untouched_ = false;
  std::optional<CheckpointFile> from_;
  std::optional<ResultsFile> results_;
  std::optional<StatesFile> states_;
  std::optional<double> cut_at_;
};

}  // namespace floatframe
