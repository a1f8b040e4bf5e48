// Long work with Python alive beside it.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bindings.hpp"

namespace floatframe::python {

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
      nb::gil_scoped_release released;
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
