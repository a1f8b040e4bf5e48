#pragma once
// A parameter study: many runs of one model file with different values, in worker processes and,
// under mpirun, on several machines. Its table depends only on the runs, not on how they were
// spread or how often the study was interrupted: each run is single-threaded, and rows go through
// the journal's text.
//
// The program itself hands out run numbers, keeps the journal and writes the table; nothing of a
// run, not even the reading of its model, happens in it, so that a run that crashes is a row.
// Under mpirun each process has its own workers; process 0 leads, the others ask it for runs.
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/simulation/range_warning.hpp"
#include "floatframe/sweep/sweep_measure.hpp"
#include "floatframe/sweep/sweep_plan.hpp"
#include "floatframe/sweep/worker_limits.hpp"

namespace floatframe {

struct SweepOptions {
  std::string model;                ///< model file
  std::optional<std::string> text;  ///< read instead of it: it says where other files are
  std::vector<SweepSetting> fixed;  ///< for all runs
  SweepPlan plan;
  std::vector<SweepMeasure> measures;  ///< empty: all outputs
  std::string folder;                  ///< sweep.csv, sweep.journal, runs/
  int threads = 1;                     ///< runs at a time: worker processes of this one
  WorkerLimits limits;                 ///< of a run; reading its model and running it one by one
  bool keep_results = false;  ///< results.csv and summary.json of every run below runs/<number>
  bool fresh = false;         ///< do not continue what is in the folder
  bool retry_failed = false;  ///< repeat the runs that failed, whatever the reason
  bool strict = false;        ///< a run with warnings has failed
};

struct SweepProgress {
  enum class Stage { checking, running } stage = Stage::checking;
  std::size_t done = 0, total = 0;  ///< runs; finished by an earlier call included
  std::size_t before = 0;           ///< runs finished by an earlier call
  double in_work = 0.0;             ///< sum of the fractions done of the runs in work
};

/// Warnings of one kind in a study.
struct SweepWarnings {
  RangeLimit limit = RangeLimit::displacement;
  std::size_t runs = 0, first = 0;  ///< how many have one; number from 1 of the first
  std::string sentence;             ///< of the first
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
  std::string journal;  ///< its path
};

/// Runs the study or what is left of it. `stop`, looked at all the time, ends it early: runs in
/// work are cancelled. Its workers are forks of the calling program: it should have no other
/// threads at this moment, or none that hold a lock that a run needs (memory and files of the C
/// library are safe). They do not run its exit handlers and touch none of its open files. Throws
/// InputError (nothing was started), OutputError, RunError.
SweepReport run_sweep(const SweepOptions& options, const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress);

}  // namespace floatframe
