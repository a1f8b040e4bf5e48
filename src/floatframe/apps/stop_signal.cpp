#include "floatframe/apps/stop_signal.hpp"

namespace floatframe {
namespace {

std::atomic<bool> signal_came{false};
std::atomic<int> signal_number{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void note_signal(int number) {
  signal_number.store(number, std::memory_order_relaxed);
  signal_came.store(true, std::memory_order_relaxed);
}

}  // namespace

StopSignal::StopSignal() {
  signal_number = 0;
  signal_came = false;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

const std::atomic<bool>& StopSignal::asked() noexcept { return signal_came; }
int StopSignal::number() noexcept { return signal_number.load(std::memory_order_relaxed); }

}  // namespace floatframe
