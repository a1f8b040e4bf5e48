#include "floatframe/sweep/worker_pool.hpp"

#include <pthread.h>

#include <csignal>
#include <utility>

namespace floatframe {

WorkerPool::WorkerPool(int threads, Work work)
    : work_(std::move(work)), progress_(static_cast<std::size_t>(threads)) {
  // Signals are for the main thread: a thread inherits the mask of the one that makes it.
  sigset_t all, before;
  sigfillset(&all);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigdelset(&all, fault);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  for (int k = 0; k < threads; ++k) threads_.emplace_back([this, k] { loop(k); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    queue_.clear();
    closed_ = true;
  }
  queued_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::push(std::size_t run) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(run);
  }
  queued_.notify_one();
}

std::optional<std::size_t> WorkerPool::take() {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  const std::size_t run = queue_.front();
  queue_.pop_front();
  return run;
}

void WorkerPool::clear() {
  const std::lock_guard lock(mutex_);
  queue_.clear();
}

std::vector<WorkerPool::Finished> WorkerPool::finished(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  done_.wait_for(lock, timeout, [this] { return !finished_.empty(); });
  return std::exchange(finished_, {});
}

double WorkerPool::in_work() const noexcept {
  double sum = 0.0;
  for (const Progress& p : progress_) sum += p.fraction.load(std::memory_order_relaxed);
  return sum;
}

void WorkerPool::loop(int thread) {
  std::atomic<double>& progress = progress_[static_cast<std::size_t>(thread)].fraction;
  while (true) {
    Finished f;
    {
      std::unique_lock lock(mutex_);
      queued_.wait(lock, [this] { return closed_ || !queue_.empty(); });
      if (closed_) return;
      f.run = queue_.front();
      queue_.pop_front();
    }
    const auto start = std::chrono::steady_clock::now();
    try {
      f.line = work_(f.run, thread, progress);
    } catch (...) {
      f.fault = std::current_exception();
    }
    f.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    progress.store(0.0, std::memory_order_relaxed);
    {
      const std::lock_guard lock(mutex_);
      finished_.push_back(std::move(f));
    }
    done_.notify_one();
  }
}

}  // namespace floatframe
