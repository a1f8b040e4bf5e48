#pragma once
// A worker process and the process that watches it. The work may crash, never end, or use up all
// memory. The watching process only forwards requests, so it can always report the outcome of one.
//
// Both are forks. Forked before the program loads MPI or starts threads, the watching process stays
// small and single-threaded, and so does every worker that it makes later as a replacement.
#include <atomic>
#include <functional>
#include <string>

#include "floatframe/sweep/worker_limits.hpp"

namespace floatframe {

/// Memory that a worker shares with the program; in a separate cache line.
struct alignas(64) WorkerState {
  std::atomic<double> progress{0.0};  ///< of the running request, 0 .. 1; set by the work
  std::atomic<bool> out_of_memory{false};
};

/// The work of a worker process: the answer to a request. An exception ends the request, not the
/// worker; std::bad_alloc is reported as insufficient memory.
using Serve = std::function<std::string(const std::string& request, WorkerState& state)>;

/// Messages from the watching process.
inline constexpr char answer_kind = 'A';  ///< what `Serve` returned
inline constexpr char lost_kind = 'L';    ///< reason of a lost answer: "crashed with signal ..."
inline constexpr char error_kind = 'E';   ///< reason why no worker can be started
/// Messages to the watching process.
inline constexpr char request_kind = 'R';

/// The watching process, to be called in a new fork: answers the requests from `socket` and ends
/// when its other end is closed. A request whose worker died is repeated once in a new worker, to
/// exclude effects of earlier requests or of a signal from outside.
[[noreturn]] void watch_over_worker(int socket, const WorkerLimits& limits, const Serve& serve,
                                    WorkerState& state);

/// For a new fork: closes all files but the standard ones and `socket`, ends with its parent
/// process, and ignores signals of the terminal.
void prepare_fork(int socket, int parent, const char* name);

}  // namespace floatframe
