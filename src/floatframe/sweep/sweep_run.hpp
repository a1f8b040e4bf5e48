#pragma once
// One run of a study from its number to its line in the journal; in one thread.
#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>

#include "floatframe/sweep/model_pool.hpp"
#include "floatframe/sweep/sweep.hpp"

namespace floatframe {

/// What is known of a run once its values were checked.
struct PreparedRun {
  using Files = std::map<std::string, std::string>;

  ModelFingerprint fingerprint;  ///< without `files` and `parameters`
  SimulationDescription simulation;
  /// Fingerprints of the files that were read, if the study keeps results; runs share them.
  std::shared_ptr<const Files> files;
};

/// A run cancelled because the study ends.
struct RunGivenUp {};

class SweepRunner {
 public:
  /// Throws InputError. Both references must outlive the runner.
  SweepRunner(const SweepOptions& options, const std::atomic<bool>& stop);

  /// Reads the model with the values of a run and checks them and the measures. Throws InputError.
  PreparedRun prepare(std::size_t run);
  /// The same, and remembers what it found, so that `line` need not read the file again.
  void check(std::size_t run);
  /// Runs it; a run that cannot start or fails gives a line that says so. Writes the files of the
  /// run if the study keeps them. Throws RunGivenUp, OutputError, RunError (a file changed
  /// meanwhile).
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
  std::shared_ptr<const PreparedRun::Files> last_files_;  // of the run prepared last
};

/// The line of a run that was lost with its process, and the files that say so if the study keeps
/// them. Throws OutputError.
std::string lost_line(const SweepOptions& options, std::size_t run, const std::string& reason);

}  // namespace floatframe
