#include "floatframe/apps/realtime_progress.hpp"

#include <fmt/format.h>

#include <chrono>

#include "floatframe/apps/command.hpp"
#include "floatframe/apps/progress_bar.hpp"

namespace floatframe {

RealTimeProgress::RealTimeProgress(double duration, bool silences, SilenceFallback fallback)
    : silences_(silences), fallback_(fallback) {
  if (silences || duration > 0.0) thread_ = std::thread([this, duration] { loop(duration); });
}

RealTimeProgress::~RealTimeProgress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void RealTimeProgress::loop(double duration) {
  ProgressBar bar(duration > 0.0, duration, "s");
  std::unique_lock lock(mutex_);
  for (int tick = 1;
       !ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return end_; }); ++tick) {
    if (silences_ && silent_since.load(std::memory_order_relaxed) != shown_) {
      bar.clear();
      report_silence();
    }
    if (duration > 0.0 && tick % 10 == 0) bar.show(time.load(std::memory_order_relaxed) / duration);
  }
}

void RealTimeProgress::report_silence() {
  const double since = silent_since.load(std::memory_order_relaxed);
  if (since >= 0.0)
    say(fmt::format("no inputs have come since t = {:.6g} s; {}", since,
                    fallback_ == SilenceFallback::hold      ? "the last values are held"
                    : fallback_ == SilenceFallback::initial ? "the initial values are used"
                                                            : "the run stops if some came before, "
                                                              "else it goes on with the initial "
                                                              "values"));
  else
    say(fmt::format("inputs arrive again at t = {:.6g} s", time.load(std::memory_order_relaxed)));
  shown_ = since;
}

}  // namespace floatframe
