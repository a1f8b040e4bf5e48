#include "floatframe/sweep/run_queue.hpp"

#include <algorithm>

namespace floatframe {

std::optional<std::size_t> RunQueue::take(int worker) {
  auto& runs = own_[worker];
  if (runs.empty()) return take();
  const std::size_t run = runs.front();
  runs.pop_front();
  return run;
}

std::optional<std::size_t> RunQueue::take() {
  const auto longest = std::max_element(
      own_.begin(), own_.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (longest == own_.end() || longest->empty()) return std::nullopt;
  const std::size_t run = longest->back();
  longest->pop_back();
  return run;
}

}  // namespace floatframe
