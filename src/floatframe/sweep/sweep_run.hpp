#pragma once
// One run of a study from its number to its line in the journal.
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "floatframe/sweep/model_pool.hpp"
#include "floatframe/sweep/sweep.hpp"

namespace floatframe {

/// What is known of a run once its values were checked.
struct PreparedRun {
  ModelFingerprint fingerprint;  ///< without `files` and `parameters`
  SimulationDescription simulation;
};

/// A run given up because the study ends.
struct RunGivenUp {};

class SweepRunner {
 public:
  SweepRunner(const SweepOptions& options, const std::atomic<bool>& stop);

  /// Reads the model with the values of a run and checks them and the measures. Several threads may
  /// call it. Throws InputError.
  PreparedRun prepare(std::size_t run);
  /// Keeps what `prepare` found, so that `line` need not read the file again; before any `line`.
  void keep(std::size_t run, PreparedRun prepared);
  /// Runs it; a run that cannot start or fails gives a line that says so. Writes the files of the
  /// run if the study keeps them. Throws RunGivenUp, OutputError, RunError (a file changed
  /// meanwhile).
  std::string line(std::size_t run, std::atomic<double>& progress);
  /// The model of a run, built or from the pool. Throws InputError.
  std::shared_ptr<const Model> model(std::size_t run, const PreparedRun& prepared);

  /// Files read so far and the fingerprints of their contents.
  std::map<std::string, std::string> files() const;
  /// Fingerprint of the contents of the files that the first run reads. Throws InputError.
  std::string files_of_first_run() const;

 private:
  SweepCase read(std::size_t run);
  std::string folder_of(std::size_t run) const;

  const SweepOptions& options_;
  const std::atomic<bool>& stop_;
  SweepCaseReader reader_;
  ModelPool pool_;
  std::vector<std::optional<PreparedRun>> prepared_;
  mutable std::mutex mutex_;
  std::map<std::string, std::string> files_;
};

}  // namespace floatframe
