// Long work that leaves other Python threads free, and threads at the end of the interpreter.
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

/// Python is ending: threads no longer request its lock.
std::atomic<bool> ending{false};
std::atomic<std::thread::id> finisher;  // the thread that ends it, which may continue
/// Number of threads requesting the lock, and of callbacks from C++ running in Python.
std::atomic<int> asking{0}, called{0};

[[noreturn]] void wait_for_exit() {
  while (true) ::pause();
}

/// Counts a request before checking whether Python is ending: after `ending` is set and the count
/// is zero, no thread is about to take the lock.
void count_request(std::atomic<int>& count) {
  ++count;
  if (!ending || std::this_thread::get_id() == finisher) return;
  --count;
  wait_for_exit();
}

/// Called by Python's atexit, with the lock held.
void end_threads() {
  finisher = std::this_thread::get_id();
  ending = true;
  PyThreadState* const state = PyEval_SaveThread();
  for (int k = 0; k < 5000 && (asking > 0 || called > 0); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  PyEval_RestoreThread(state);
}

}  // namespace

Unlocked::Unlocked() : state_(PyEval_SaveThread()) {}

Unlocked::~Unlocked() {
  count_request(asking);
  PyEval_RestoreThread(state_);
  --asking;
}

Locked::Locked() {
  count_request(called);
  state_ = PyGILState_Ensure();
}

Locked::~Locked() {
  PyGILState_Release(state_);
  --called;
}

void bind_threads() {
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(end_threads));
}

void interruptible(std::atomic<bool>& stop, const std::function<void()>& run,
                   const std::function<void()>& watch) {
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr failed;
  std::thread worker([&] {
    try {
      run();
    } catch (...) {
      failed = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    done = true;
    ended.notify_all();
  });
  std::exception_ptr interrupted;
  while (true) {
    bool over = false;
    {
      Unlocked released;
      std::unique_lock lock(mutex);
      over = ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; });
    }
    if (over) break;
    if (interrupted) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      watch();
    } catch (...) {
      interrupted = std::current_exception();
      stop = true;
    }
  }
  worker.join();
  if (interrupted) std::rethrow_exception(interrupted);
  if (failed) std::rethrow_exception(failed);
}

}  // namespace floatframe::python
