#pragma once
// The worker processes of a study as the study sees them: runs are given to them, and each comes
// back with an answer or with the reason why there is none.
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
    std::string lost;      ///< why there is no answer: "crashed with signal ..."; else empty
    double seconds = 0.0;  ///< how long it took
  };

  /// Makes the processes by forking this one, as many as there are runs at most: best before the
  /// program has loaded MPI or has threads. `options` must outlive them. Throws RunError.
  explicit SweepWorkers(const SweepOptions& options);

  int size() const noexcept { return pool_.size(); }
  bool idle(int worker) const { return pool_.idle(worker); }
  bool all_idle() const { return pool_.all_idle(); }
  double in_work() const { return pool_.in_work(); }
  void give(int worker, const ServiceRequest& request);
  /// See ProcessPool. Throws RunError, also for what a worker says must end the study and if a file
  /// was changed meanwhile.
  std::vector<Answer> answers(std::chrono::milliseconds timeout);
  std::optional<Answer> ask(int worker, const ServiceRequest& request,
                            const std::atomic<bool>& stop);
  void give_up() { pool_.give_up(); }

  /// All files that were read, and the fingerprints of their contents.
  const std::map<std::string, std::string>& files() const noexcept { return files_; }

 private:
  Answer understood(ProcessPool::Answer&& answer);

  ProcessPool pool_;
  std::vector<std::size_t> run_of_;  ///< what each worker was given
  std::map<std::string, std::string> files_;
};

}  // namespace floatframe
