#pragma once
// Threads that work through a queue of run numbers. Nothing is shared inside a run: the queue is
// locked once when a run begins and once when it ends.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace floatframe {

class WorkerPool {
 public:
  struct Finished {
    std::size_t run = 0;
    std::string line;          ///< what the work returned
    std::exception_ptr fault;  ///< or what it threw
    double seconds = 0.0;      ///< how long it took
  };
  /// The line of a run; called by the threads, numbered from 0. `progress` may be set between 0
  /// and 1.
  using Work =
      std::function<std::string(std::size_t run, int thread, std::atomic<double>& progress)>;

  WorkerPool(int threads, Work work);
  /// Gives up what is queued and waits for the runs that are in work.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  void push(std::size_t run);
  /// Takes away the run that would be started next.
  std::optional<std::size_t> take();
  /// Gives up what is queued.
  void clear();
  /// What has finished since the last call; waits for something, but not longer than `timeout`.
  std::vector<Finished> finished(std::chrono::milliseconds timeout);
  /// Sum over the runs in work of the fraction done.
  double in_work() const noexcept;
  int threads() const noexcept { return static_cast<int>(threads_.size()); }

 private:
  struct alignas(64) Progress {  // a cache line each: threads do not disturb one another
    std::atomic<double> fraction{0.0};
  };
  void loop(int thread);

  Work work_;
  std::mutex mutex_;
  std::condition_variable queued_, done_;
  std::deque<std::size_t> queue_;
  std::vector<Finished> finished_;
  bool closed_ = false;
  std::vector<Progress> progress_;
  std::vector<std::thread> threads_;
};

}  // namespace floatframe
