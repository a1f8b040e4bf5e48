#include "floatframe/sweep/worker_guard.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "floatframe/sweep/message_pipe.hpp"
#include "floatframe/sweep/process_memory.hpp"

namespace floatframe {
namespace {

constexpr char exception_kind = 'X';  // worker -> watching process: text of an exception

WorkerState* own_state = nullptr;  // of this worker, for handlers

[[noreturn]] void end_without_memory() {
  own_state->out_of_memory.store(true);
  ::_exit(1);
}

/// Called on a failed allocation inside a noexcept function.
[[noreturn]] void end_by_terminate() {
  if (const std::exception_ptr exception = std::current_exception()) {
    try {
      std::rethrow_exception(exception);
    } catch (const std::bad_alloc&) {
      end_without_memory();
    } catch (...) {  // reported as SIGABRT
    }
  }
  std::abort();
}

/// Runs allocate and free the same memory repeatedly: without this the C library returns it to the
/// system each time, which costs up to a tenth of a short run.
void retain_heap() {
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
  ::mallopt(M_MMAP_THRESHOLD, 16 << 20);
  ::mallopt(M_TOP_PAD, 1 << 20);
}

[[noreturn]] void work(int socket, const WorkerLimits& limits, const Serve& serve,
                       WorkerState& state) {
  own_state = &state;
  std::set_terminate(end_by_terminate);
  retain_heap();
  MessageReader reader;
  PipeMessage request;
  try {
    while (reader.wait(socket, request)) {
      std::string message = "an exception of an unknown kind";
      try {
        const bool watched = limits.megabytes > 0.0 && forget_peak_memory();
        const std::string answer = serve(request.text, state);
        if (watched && peak_memory() > limits.megabytes) end_without_memory();
        send_message(socket, answer_kind, answer);
        continue;
      } catch (const std::bad_alloc&) {
        end_without_memory();
      } catch (const std::exception& error) {
        message = error.what();
      } catch (...) {
      }
      send_message(socket, exception_kind, message);
    }
  } catch (const std::bad_alloc&) {
    end_without_memory();
  }
  ::_exit(0);
}

std::string lower_first(std::string text) {
  if (text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a')
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

std::string end_reason(int status, bool out_of_memory, const WorkerLimits& limits) {
  if (out_of_memory)
    return limits.megabytes > 0.0
               ? fmt::format("needed more than {:.15g} MB (--case-memory)", limits.megabytes)
               : "needed more memory than was available";
  if (WIFEXITED(status))
    return fmt::format("ended the process with exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGKILL)
    return "crashed with signal KILL (killed from outside, by the system if memory ran out)";
  const char* name = ::sigabbrev_np(signal);
  const char* words = ::sigdescr_np(signal);
  return fmt::format("crashed with signal {} ({})", name ? name : std::to_string(signal),
                     words ? lower_first(words) : "unknown");
}

class Guard {
 public:
  Guard(int socket, const WorkerLimits& limits, const Serve& serve, WorkerState& state)
      : socket_(socket), limits_(limits), serve_(serve), state_(state) {}

  void loop() {
    PipeMessage request;
    while (requests_.wait(socket_, request))
      if (!answer(request.text)) break;
    stop_worker();
  }

 private:
  enum class End { answered, died, over_memory, timed_out, caller_gone };

  /// False if the caller no longer waits for the answer.
  bool answer(const std::string& request) {
    std::string lost;
    for (int attempt = 0; attempt < 2; ++attempt) {
      if (const int error = make_ready(); error != 0)
        return send_message(socket_, error_kind, std::strerror(error));
      PipeMessage message;
      switch (wait_for_answer(request, message)) {
        case End::answered:
          if (message.kind == answer_kind) return send_message(socket_, answer_kind, message.text);
          return send_message(socket_, lost_kind, "ended by an exception: " + message.text);
        case End::over_memory:
          stop_worker();
          lost = end_reason(0, true, limits_);
          break;
        case End::timed_out:
          stop_worker();
          return send_message(
              socket_, lost_kind,
              fmt::format("stopped after {:.15g} s (--case-timeout)", limits_.seconds));
        case End::caller_gone:
          return false;
        case End::died:
          lost = end_reason(reap(), state_.out_of_memory.load(), limits_);
      }
    }
    return send_message(socket_, lost_kind, lost);
  }

  /// Ensures a living worker; returns 0 or the system's error number.
  int make_ready() {
    if (worker_ > 0) {
      // A worker that ended while idle is not an error.
      pollfd ready{to_worker_, POLLIN, 0};
      if (::poll(&ready, 1, 0) > 0) stop_worker();
    }
    state_.progress.store(0.0);
    state_.out_of_memory.store(false);
    if (worker_ > 0) return 0;
    int end_of_worker = -1;
    if (const int error = open_pipe(to_worker_, end_of_worker); error != 0) return error;
    const pid_t self = ::getpid();
    worker_ = ::fork();
    const int error = worker_ < 0 ? errno : 0;
    if (worker_ == 0) {
      prepare_fork(end_of_worker, self, "sweep-worker");
      work(end_of_worker, limits_, serve_, state_);
    }
    ::close(end_of_worker);
    if (error != 0) ::close(to_worker_);
    answers_ = {};
    return error;
  }

  End wait_for_answer(const std::string& request, PipeMessage& message) {
    if (!send_message(to_worker_, request_kind, request)) return End::died;
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    // Waits in slices and caps the time counted per slice, so that time during which the whole
    // study was stopped (Ctrl-Z) is not charged to the run.
    const bool timed = limits_.seconds > 0.0, watched = limits_.megabytes > 0.0;
    const double slice = watched ? 0.02 : 0.1;
    double left = limits_.seconds;
    while (true) {
      pollfd ready[2]{{to_worker_, POLLIN, 0}, {socket_, POLLIN, 0}};
      const auto start = Clock::now();
      const double wait_seconds = timed ? std::clamp(left, 0.0, slice) : slice;
      ::poll(ready, 2, timed || watched ? 1 + static_cast<int>(1e3 * wait_seconds) : -1);
      if (ready[1].revents != 0) return End::caller_gone;
      if (ready[0].revents != 0) {
        const MessageReader::State state = answers_.read(to_worker_, message);
        if (state == MessageReader::State::complete) return End::answered;
        if (state == MessageReader::State::closed) return End::died;
      }
      if (watched && memory_of(worker_) > limits_.megabytes) return End::over_memory;
      left -= std::min(Seconds(Clock::now() - start).count(), 2.0 * slice);
      if (timed && left <= 0.0) return End::timed_out;
    }
  }

  /// The reason why a worker that closed its socket ended.
  int reap() {
    // A worker that closes the socket but lives on is terminated.
    ::close(to_worker_);
    int status = 0;
    for (int k = 0; k < 200; ++k) {
      const pid_t ended = ::waitpid(worker_, &status, WNOHANG);
      if (ended != 0) {
        worker_ = -1;
        return status;
      }
      ::poll(nullptr, 0, 10);
    }
    ::kill(worker_, SIGKILL);
    ::waitpid(worker_, &status, 0);
    worker_ = -1;
    return status;
  }

  void stop_worker() {
    if (worker_ <= 0) return;
    ::close(to_worker_);
    ::kill(worker_, SIGKILL);
    ::waitpid(worker_, nullptr, 0);
    worker_ = -1;
  }

  int socket_, to_worker_ = -1;
  pid_t worker_ = -1;
  const WorkerLimits& limits_;
  const Serve& serve_;
  WorkerState& state_;
  MessageReader requests_, answers_;
};

}  // namespace

void prepare_fork(int socket, int parent, const char* name) {
  ::prctl(PR_SET_NAME, name);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it ended before
  // The program handles signals to the process group and decides about the runs; crash signals get
  // the default action, whatever handlers the program or a sanitizer has installed.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGPIPE})
    std::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGCHLD})
    std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  // Otherwise this process would hold file locks and keep other processes' sockets open.
  if (::close_range(3, static_cast<unsigned>(socket - 1), 0) == 0 || socket == 3) {
    if (::close_range(static_cast<unsigned>(socket + 1), ~0U, 0) == 0) return;
  }
  const long most = std::clamp(::sysconf(_SC_OPEN_MAX), 256L, 65536L);
  for (int file = 3; file < most; ++file)
    if (file != socket) ::close(file);
}

void watch_over_worker(int socket, const WorkerLimits& limits, const Serve& serve,
                       WorkerState& state) {
  Guard(socket, limits, serve, state).loop();
  ::_exit(0);
}

}  // namespace floatframe
