#include "floatframe/sweep/process_pool.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

RunError cannot_start(const std::string& why) {
  return RunError(ErrorCode::worker_lost, "a worker process cannot be started: " + why);
}

}  // namespace

ProcessPool::ProcessPool(int workers, const WorkerLimits& limits, const Work& work) {
  const std::size_t count = std::max(1, workers);
  memory_size_ = sizeof(WorkerState) * (1 + count);
  static_assert(sizeof(SharedFlags) <= sizeof(WorkerState));
  memory_ =
      ::mmap(nullptr, memory_size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED) throw cannot_start(std::strerror(errno));
  flags_ = new (memory_) SharedFlags;
  auto* states = static_cast<WorkerState*>(memory_) + 1;
  workers_.resize(count);
  try {
    for (std::size_t k = 0; k < count; ++k) {
      workers_[k].state = new (states + k) WorkerState;
      start(workers_[k], limits, work);
    }
  } catch (...) {
    end();
    throw;
  }
}

ProcessPool::~ProcessPool() { end(); }

void ProcessPool::start(Worker& worker, const WorkerLimits& limits, const Work& work) {
  int guard_end = -1;
  if (const int error = open_pipe(worker.socket, guard_end); error != 0)
    throw cannot_start(std::strerror(error));
  const pid_t self = ::getpid();
  worker.process = ::fork();
  if (worker.process == 0) {
    prepare_fork(guard_end, self, "sweep-guard");
    const SharedFlags& flags = *flags_;
    const Serve serve = [&](const std::string& request, WorkerState& state) {
      return work(request, state, flags);
    };
    watch_over_worker(guard_end, limits, serve, *worker.state);
  }
  const int error = worker.process < 0 ? errno : 0;
  ::close(guard_end);
  if (error != 0) throw cannot_start(std::strerror(error));
}

void ProcessPool::end() noexcept {
  if (flags_) flags_->give_up.store(true);
  // Close all sockets first, then wait: each watching process then ends its worker and itself.
  for (Worker& w : workers_)
    if (w.socket >= 0) ::close(w.socket);
  for (Worker& w : workers_)
    while (w.process > 0 && ::waitpid(w.process, nullptr, 0) < 0 && errno == EINTR) {
    }
  workers_.clear();
  if (memory_ && memory_ != MAP_FAILED) ::munmap(memory_, memory_size_);
  memory_ = nullptr;
}

bool ProcessPool::all_idle() const {
  return std::all_of(workers_.begin(), workers_.end(),
                     [](const Worker& w) { return w.request.empty(); });
}

void ProcessPool::give(int worker, const std::string& request) {
  Worker& w = workers_[worker];
  w.request = request;
  w.start = std::chrono::steady_clock::now();
  if (!send_message(w.socket, request_kind, request))
    throw RunError(ErrorCode::worker_lost, "the watching process of a worker was killed");
}

std::vector<ProcessPool::Answer> ProcessPool::answers(std::chrono::milliseconds timeout) {
  std::vector<pollfd> ready;
  for (const Worker& w : workers_)
    ready.push_back({w.request.empty() ? -1 : w.socket, POLLIN, 0});  // negative: ignored
  std::vector<Answer> found;
  if (::poll(ready.data(), ready.size(), static_cast<int>(timeout.count())) <= 0) return found;
  const auto now = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < workers_.size(); ++k) {
    if (ready[k].revents == 0) continue;
    Worker& w = workers_[k];
    PipeMessage message;
    const MessageReader::State state = w.reader.read(w.socket, message);
    if (state == MessageReader::State::incomplete) continue;
    if (state == MessageReader::State::closed)
      throw RunError(ErrorCode::worker_lost, "the watching process of a worker was killed");
    if (message.kind == error_kind) throw cannot_start(message.text);
    Answer answer{static_cast<int>(k), std::move(w.request), "", "",
                  std::chrono::duration<double>(now - w.start).count()};
    (message.kind == lost_kind ? answer.lost : answer.text) = std::move(message.text);
    w.request.clear();
    w.state->progress.store(0.0, std::memory_order_relaxed);
    found.push_back(std::move(answer));
  }
  return found;
}

std::optional<ProcessPool::Answer> ProcessPool::ask(int worker, const std::string& request,
                                                    const std::atomic<bool>& stop) {
  give(worker, request);
  while (!stop.load()) {
    std::vector<Answer> found = answers(std::chrono::milliseconds(50));
    if (!found.empty()) return std::move(found.front());
  }
  return std::nullopt;
}

double ProcessPool::in_work() const {
  double sum = 0.0;
  for (const Worker& w : workers_)
    if (!w.request.empty()) sum += w.state->progress.load(std::memory_order_relaxed);
  return sum;
}

}  // namespace floatframe
