#pragma once
// The pending runs. A worker that has checked a run still holds its inputs, so each worker gets the
// runs it has checked first, and runs of other workers at the end.
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace floatframe {

class RunQueue {
 public:
  explicit RunQueue(int workers) : own_(workers) {}

  /// A run that `worker` has checked.
  void push(std::size_t run, int worker) { own_[worker].push_back(run); }
  /// Next run for a worker.
  std::optional<std::size_t> take(int worker);
  /// Next run for a worker without pending runs: the last one of the worker with the most.
  std::optional<std::size_t> take();
  void clear() {
    for (auto& runs : own_) runs.clear();
  }

 private:
  std::vector<std::deque<std::size_t>> own_;
};

}  // namespace floatframe
