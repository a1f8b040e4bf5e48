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

constexpr char exception_kind = 'X';  // worker -> watching process: what was thrown

WorkerState* own_state = nullptr;  // of this worker, for handlers

[[noreturn]] void end_without_memory() {
  own_state->out_of_memory.store(true);
  ::_exit(1);
}

/// A failed allocation inside a function that must not throw ends here.
[[noreturn]] void end_by_terminate() {
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      end_without_memory();
    } catch (...) {  // reported as what it is: SIGABRT
    }
  }
  std::abort();
}

/// Runs take and give back the same memory again and again: without this the C library gives it
/// back to the system each time, which costs as much as a tenth of a short run.
void keep_memory() {
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
  ::mallopt(M_MMAP_THRESHOLD, 16 << 20);
  ::mallopt(M_TOP_PAD, 1 << 20);
}

[[noreturn]] void work(int socket, const WorkerLimits& limits, const Serve& serve,
                       WorkerState& state) {
  own_state = &state;
  std::set_terminate(end_by_terminate);
  keep_memory();
  MessageReader reader;
  PipeMessage request;
  try {
    while (reader.wait(socket, request)) {
      std::string thrown = "an exception of an unknown kind";
      try {
        const bool watched = limits.megabytes > 0.0 && forget_peak_memory();
        const std::string answer = serve(request.text, state);
        if (watched && peak_memory() > limits.megabytes) end_without_memory();
        send_message(socket, answer_kind, answer);
        continue;
      } catch (const std::bad_alloc&) {
        end_without_memory();
      } catch (const std::exception& error) {
        thrown = error.what();
      } catch (...) {
      }
      send_message(socket, exception_kind, thrown);
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

std::string end_in_words(int status, bool out_of_memory, const WorkerLimits& limits) {
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
  enum class End { answered, died, large, late, deserted };

  /// False if nobody waits for the answer any more.
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
        case End::large:
          stop_worker();
          lost = end_in_words(0, true, limits_);
          break;
        case End::late:
          stop_worker();
          return send_message(
              socket_, lost_kind,
              fmt::format("stopped after {:.15g} s (--case-timeout)", limits_.seconds));
        case End::deserted:
          return false;
        case End::died:
          lost = end_in_words(reap(), state_.out_of_memory.load(), limits_);
      }
    }
    return send_message(socket_, lost_kind, lost);
  }

  /// A living worker; 0 or the system's error number.
  int make_ready() {
    if (worker_ > 0) {
      // One that ended while it had nothing to do has done nothing wrong.
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
      settle_in_fork(end_of_worker, self, "sweep-worker");
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
    // In slices, of which none counts much longer than it was meant to be: time in which the whole
    // study was stopped (Ctrl-Z) is not the case's.
    const bool timed = limits_.seconds > 0.0, watched = limits_.megabytes > 0.0;
    const double slice = watched ? 0.02 : 0.1;
    double left = limits_.seconds;
    while (true) {
      pollfd ready[2]{{to_worker_, POLLIN, 0}, {socket_, POLLIN, 0}};
      const auto start = Clock::now();
      const double patience = timed ? std::clamp(left, 0.0, slice) : slice;
      ::poll(ready, 2, timed || watched ? 1 + static_cast<int>(1e3 * patience) : -1);
      if (ready[1].revents != 0) return End::deserted;
      if (ready[0].revents != 0) {
        const MessageReader::State state = answers_.read(to_worker_, message);
        if (state == MessageReader::State::complete) return End::answered;
        if (state == MessageReader::State::closed) return End::died;
      }
      if (watched && memory_of(worker_) > limits_.megabytes) return End::large;
      left -= std::min(Seconds(Clock::now() - start).count(), 2.0 * slice);
      if (timed && left <= 0.0) return End::late;
    }
  }

  /// How the worker, which has closed its socket, ended.
  int reap() {
    // Nothing else closes it; but a worker that does is ended.
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

void settle_in_fork(int socket, int parent, const char* name) {
  ::prctl(PR_SET_NAME, name);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it ended before that
  // A signal to the group of processes is for the program, which decides what becomes of the runs;
  // what a crash does is the system's matter, whatever the program or a sanitizer had arranged.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGPIPE})
    std::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGCHLD})
    std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  // Else this process would hold locks of files and keep other processes' sockets open.
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
