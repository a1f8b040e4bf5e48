#pragma once
// The runs that are left to do. A worker that has checked a run knows what it read, so each is
// given its own ones first, and those of others at the end.
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
  /// For a worker.
  std::optional<std::size_t> take(int worker);
  /// For whoever has checked nothing: from the worker that has most to do, its last.
  std::optional<std::size_t> take();
  void clear() {
    for (auto& runs : own_) runs.clear();
  }

 private:
  std::vector<std::deque<std::size_t>> own_;
};

}  // namespace floatframe
