#pragma once
// Progress of a long computation, for display; costs next to nothing without a listener.
#include <functional>
#include <utility>

namespace floatframe {

/// Receives the name of the work and the fraction done, 0 to 1.
using ProgressListener = std::function<void(const char* work, double done)>;

namespace detail {
inline thread_local const ProgressListener* progress_listener = nullptr;
}

/// While it exists, `listener` receives the progress of this thread.
class ListenToProgress {
 public:
  explicit ListenToProgress(ProgressListener listener)
      : own_(std::move(listener)), before_(detail::progress_listener) {
    detail::progress_listener = &own_;
  }
  ~ListenToProgress() { detail::progress_listener = before_; }
  ListenToProgress(const ListenToProgress&) = delete;
  ListenToProgress& operator=(const ListenToProgress&) = delete;

 private:
  ProgressListener own_;
  const ProgressListener* before_;
};

inline void tell_progress(const char* work, double done) {
  if (detail::progress_listener) (*detail::progress_listener)(work, done);
}

}  // namespace floatframe
