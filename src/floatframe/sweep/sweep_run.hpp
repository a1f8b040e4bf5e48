#pragma once
// One run of a study, from its number to its journal line; in one thread.
#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "floatframe/sweep/model_pool.hpp"
#include "floatframe/sweep/sweep.hpp"

namespace floatframe {

/// Data of a run whose values have been checked.
struct PreparedRun {
  using Files = std::map<std::string, std::string>;

  ModelFingerprint fingerprint;  ///< without `files` and `parameters`
  SimulationDescription simulation;
  /// Fingerprints of the files that were read, if results are recorded; shared by runs.
  std::shared_ptr<const Files> files;
};

/// Thrown for a run cancelled because the study ends.
struct RunCancelled {};

/// `folder`/runs/<number from 1>, with as many digits as the last one.
std::string folder_of_run(const SweepOptions& options, std::size_t run);
/// Values of a run, in the form of `run --set`.
std::vector<std::string> settings_of(const SweepOptions& options, std::size_t run);

class SweepRunner {
 public:
  /// Throws InputError. Both references must outlive the runner.
  SweepRunner(const SweepOptions& options, const std::atomic<bool>& stop);

  /// Reads the model with the values of a run and checks them and the measures. Throws InputError.
  PreparedRun prepare(std::size_t run);
  /// The same, and keeps the result, so that `line` need not read the file again.
  void check(std::size_t run);
  /// Executes a run; if it cannot start or fails, the line contains the reason. Writes the files of
  /// the run if the study records them. Throws RunCancelled, OutputError, RunError (a file was
  /// changed meanwhile).
  std::string line(std::size_t run, std::atomic<double>& progress);
  /// The model of a run, built or from the pool. Throws InputError.
  std::shared_ptr<const Model> model(std::size_t run, const PreparedRun& prepared);

  /// Files read so far and the fingerprints of their contents.
  const std::map<std::string, std::string>& files() const noexcept { return files_; }
  /// Fingerprint of the contents of the files that the first run reads. Throws InputError.
  std::string files_of_first_run() const;

 private:
  SweepCase read(std::size_t run);
  SweepCase read_checked(std::size_t run);
  PreparedRun prepared_from(const SweepCase& c);

  const SweepOptions& options_;
  const std::atomic<bool>& stop_;
  SweepCaseReader reader_;
  ModelPool pool_;
  std::unordered_map<std::size_t, PreparedRun> prepared_;
  std::map<std::string, std::string> files_;
  std::shared_ptr<const PreparedRun::Files> last_files_;  // of the last run prepared
};

/// The line of a run lost with its process, and its files with the reason if the study records
/// files. Throws OutputError.
std::string lost_line(const SweepOptions& options, std::size_t run, const std::string& reason);

}  // namespace floatframe
