#pragma once
// Worker processes that answer requests, one at a time each, and tolerate any failure of a request:
// if its worker crashes or exceeds the limit of time or memory, the answer is the reason, and the
// next request gets a new worker.
//
// The processes are forks of this one, made by the constructor: preferably before the program loads
// MPI or starts threads. They end with it, however it ends, or with the thread that made them.
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/sweep/message_pipe.hpp"
#include "floatframe/sweep/worker_guard.hpp"

namespace floatframe {

/// Flags visible to worker processes: set to cancel running requests.
struct SharedFlags {
  std::atomic<bool> give_up{false};
};

class ProcessPool {
 public:
  struct Answer {
    int worker = 0;
    std::string request, text;
    std::string lost;      ///< reason for a missing answer; empty: there is one
    double seconds = 0.0;  ///< duration [s]
  };
  using Work = std::function<std::string(const std::string& request, WorkerState& state,
                                         const SharedFlags& flags)>;

  /// Throws RunError if the system refuses more processes.
  ProcessPool(int workers, const WorkerLimits& limits, const Work& work);
  /// Terminates running requests immediately.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  int size() const noexcept { return static_cast<int>(workers_.size()); }
  bool idle(int worker) const { return workers_[worker].request.empty(); }
  bool all_idle() const;
  /// Sends a request to an idle worker. Throws RunError if the worker is gone.
  void give(int worker, const std::string& request);
  /// Answers received since the last call; waits for the first one, at most `timeout`. Throws
  /// RunError if workers cannot be started or were killed.
  std::vector<Answer> answers(std::chrono::milliseconds timeout);
  /// Sends a request to an idle pool and waits for the answer. None if `stop` was set first.
  std::optional<Answer> ask(int worker, const std::string& request, const std::atomic<bool>& stop);
  /// Sum over the running requests of the fraction done.
  double in_work() const;
  /// Requests cancellation of running requests.
  void give_up() { flags_->give_up.store(true); }

 private:
  struct Worker {
    int socket = -1, process = -1;
    std::string request;  ///< running; empty: idle
    std::chrono::steady_clock::time_point start;
    MessageReader reader;
    WorkerState* state = nullptr;
  };
  void start(Worker& worker, const WorkerLimits& limits, const Work& work);
  void end() noexcept;

  void* memory_ = nullptr;  ///< shared with all workers: flags and states
  std::size_t memory_size_ = 0;
  SharedFlags* flags_ = nullptr;
  std::vector<Worker> workers_;
};

}  // namespace floatframe
