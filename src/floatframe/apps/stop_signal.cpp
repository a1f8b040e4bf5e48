#include "floatframe/apps/stop_signal.hpp"

namespace floatframe {
namespace {

std::atomic<bool> signal_came{false};
std::atomic<int> signal_number{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void note_signal(int number) {
  if (!signal_came.load(std::memory_order_relaxed))
    signal_number.store(number, std::memory_order_relaxed);
  signal_came.store(true, std::memory_order_relaxed);
}

}  // namespace

StopSignal::StopSignal(int flags) {
  signal_number = 0;
  signal_came = false;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = flags | (signals[k] == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND));
    sigemptyset(&action.sa_mask);
    sigaction(signals[k], &action, &before_[k]);
    if (signals[k] == SIGHUP && before_[k].sa_handler == SIG_IGN)
      sigaction(SIGHUP, &before_[k], nullptr);
  }
}

StopSignal::~StopSignal() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
}

const std::atomic<bool>& StopSignal::flag() noexcept { return signal_came; }
int StopSignal::number() noexcept { return signal_number.load(std::memory_order_relaxed); }

}  // namespace floatframe
