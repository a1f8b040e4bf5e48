#pragma once
// A parameter study: many runs of one model file with different values, in worker processes and,
// under mpirun, on several machines. The table depends only on the runs, not on their distribution
// or on interruptions of the study: each run is single-threaded, and rows pass through the text of
// the journal.
//
// The main process distributes run numbers, keeps the journal and writes the table; workers read
// the models and run them, so that a crash becomes a row of the table. Under mpirun each process
// has its own workers; process 0 leads, the others request runs from it.
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/run/range_warning.hpp"
#include "floatframe/sweep/sweep_measure.hpp"
#include "floatframe/sweep/sweep_plan.hpp"
#include "floatframe/sweep/worker_limits.hpp"

namespace floatframe {

struct SweepOptions {
  std::string model;                ///< model file
  std::optional<std::string> text;  ///< read instead of it; paths are relative to `model`
  std::vector<SweepSetting> fixed;  ///< for all runs
  SweepPlan plan;
  std::vector<SweepMeasure> measures;  ///< empty: all outputs
  std::string folder;                  ///< sweep.csv, sweep.journal, runs/
  int threads = 1;                     ///< runs at a time: worker processes of this process
  WorkerLimits limits;                 ///< of a run, for reading and for running separately
  bool keep_results = false;  ///< results.csv and summary.json of every run below runs/<number>
  bool fresh = false;         ///< do not continue a study in the folder
  bool retry_failed = false;  ///< repeat the failed runs, whatever the reason
  bool strict = false;        ///< warnings count as failures
  /// Page of the complete study; empty: none. Its curves are those of the runs
  /// whose results are kept.
  std::string report;
  /// The best and the worst run by it are run once more, into `folder`/best and `folder`/worst,
  /// each with its page. Only with a report.
  std::optional<SweepRanking> ranking;
};

struct SweepProgress {
  enum class Stage { checking, running } stage = Stage::checking;
  std::size_t done = 0, total = 0;  ///< runs; finished by an earlier call included
  std::size_t before = 0;           ///< runs finished by an earlier call
  double in_work = 0.0;             ///< sum of the fractions done of running runs
};

/// Warnings of one kind in a study.
struct SweepWarnings {
  RangeLimit limit = RangeLimit::displacement;
  std::size_t runs = 0, first = 0;  ///< number of runs; number from 1 of the first
  std::string sentence;             ///< of the first run
};

struct SweepReport {
  std::size_t runs = 0;      ///< of the study
  std::size_t finished = 0;  ///< of these; fewer only if interrupted
  std::size_t before = 0;    ///< finished by earlier calls
  std::size_t failed = 0;
  std::size_t first_failed = 0;  ///< number from 1, 0: none
  std::string first_message;
  std::size_t warned = 0;  ///< runs with warnings about the range of the method
  std::vector<SweepWarnings> warnings;
  bool interrupted = false;
  std::string table;    ///< path of the table; empty if interrupted
  std::string journal;  ///< path of the journal
  std::string page;     ///< path of the page; empty: none
};

/// Runs the study or its remaining runs. `stop`, polled continuously, ends it early: running runs
/// are cancelled. Its workers are forks of the calling program, which should have no other threads
/// at this moment, or none that hold a lock that a run needs (memory and files of the C library are
/// safe). Workers run none of its exit handlers and do not use its open files. Throws InputError
/// (nothing was started), OutputError, RunError.
SweepReport run_sweep(const SweepOptions& options, const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress);

}  // namespace floatframe
