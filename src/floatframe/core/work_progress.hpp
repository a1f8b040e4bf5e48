#pragma once
// How far a long computation is, for whoever shows it; costs next to nothing where nobody does.
#include <functional>
#include <utility>

namespace floatframe {

/// Shows what is being done and the part of it that is done, 0 to 1.
using ProgressListener = std::function<void(const char* work, double done)>;

namespace detail {
inline thread_local const ProgressListener* progress_listener = nullptr;
}

/// As long as it lives, `listener` hears of the work of this thread.
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
