#pragma once
// A worker process and the process that watches over it. The work may do anything: end by a signal,
// never end, take all memory. The watching process does nothing but hand requests on, so it is
// always there to say what has become of one.
//
// Both are forks. Forked before the program loads MPI or makes threads, the watching process stays
// small and has one thread, and so has every worker that it makes later in place of one that ended.
#include <atomic>
#include <functional>
#include <string>

#include "floatframe/sweep/worker_limits.hpp"

namespace floatframe {

/// Memory that a worker shares with the program; a cache line of its own.
struct alignas(64) WorkerState {
  std::atomic<double> progress{0.0};  ///< of the running request, 0 .. 1; set by the work
  std::atomic<bool> out_of_memory{false};
};

/// What the worker process does: the answer to a request. Whatever it throws ends the request, not
/// the worker; std::bad_alloc counts as memory that was not there.
using Serve = std::function<std::string(const std::string& request, WorkerState& state)>;

/// Messages from the watching process.
inline constexpr char answer_kind = 'A';  ///< what `Serve` returned
inline constexpr char lost_kind = 'L';    ///< there is none, and why: "crashed with signal ..."
inline constexpr char error_kind = 'E';   ///< no worker can be started, and why
/// Messages to it.
inline constexpr char request_kind = 'R';

/// The watching process, to be called in a new fork: answers the requests that come through
/// `socket` and ends when its other end is closed. A request whose worker died is tried once more
/// in a new worker: what counts is a process that has done nothing else, whatever the first was
/// left with by earlier requests, or whoever killed it.
[[noreturn]] void watch_over_worker(int socket, const WorkerLimits& limits, const Serve& serve,
                                    WorkerState& state);

/// For a new fork: closes all files but standard ones and `socket`, ends with the process that made
/// it, and leaves the signals of the terminal to that.
void settle_in_fork(int socket, int parent, const char* name);

}  // namespace floatframe
