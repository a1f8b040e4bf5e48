#pragma once
// The worker processes of a study: they receive run numbers, and each returns an answer or the
// reason why there is none.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/sweep/process_pool.hpp"
#include "floatframe/sweep/sweep_service.hpp"

namespace floatframe {

class SweepWorkers {
 public:
  struct Answer : ServiceAnswer {
    int worker = 0;
    std::size_t run = 0;
    std::string lost;      ///< reason for a missing answer: "crashed with signal ..."
    double seconds = 0.0;  ///< duration [s]
  };

  /// Forks this process, at most once per run: preferably before the program loads MPI or starts
  /// threads. `options` must outlive them. Throws RunError.
  explicit SweepWorkers(const SweepOptions& options);

  int size() const noexcept { return pool_.size(); }
  bool idle(int worker) const { return pool_.idle(worker); }
  bool all_idle() const { return pool_.all_idle(); }
  double in_work() const { return pool_.in_work(); }
  void give(int worker, const ServiceRequest& request);
  /// See ProcessPool. Throws RunError, also for an error of a worker that ends the study and if a
  /// file was changed meanwhile.
  std::vector<Answer> answers(std::chrono::milliseconds timeout);
  std::optional<Answer> ask(int worker, const ServiceRequest& request,
                            const std::atomic<bool>& stop);
  void give_up() { pool_.give_up(); }

  /// All files that were read, and the fingerprints of their contents.
  const std::map<std::string, std::string>& files() const noexcept { return files_; }

 private:
  Answer understood(ProcessPool::Answer&& answer);

  ProcessPool pool_;
  std::vector<std::size_t> run_of_;  ///< the run of each worker
  std::map<std::string, std::string> files_;
};

}  // namespace floatframe
