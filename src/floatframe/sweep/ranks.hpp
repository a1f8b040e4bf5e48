#pragma once
// The processes of a study started on several at once (mpirun), seen from the study: numbered 0 ..
// size-1, sending each other texts. It is implemented with MPI, in a separate module
// (`libfloatframe_mpi.so`) that is loaded only when the program was started that way, so that the
// program runs on machines without MPI.
#include <memory>
#include <string>

namespace floatframe {

struct RankMessage {
  int from = 0;
  std::string text;
};

/// All functions must be called by the thread that opened the ranks.
class Ranks {
 public:
  virtual ~Ranks() = default;  ///< waits until all ranks have finished
  virtual int rank() const noexcept = 0;
  virtual int size() const noexcept = 0;
  virtual void send(int to, const std::string& text) = 0;
  /// The next message if one has arrived; does not block.
  virtual bool receive(RankMessage& message) = 0;
  /// Terminates all ranks immediately.
  [[noreturn]] virtual void abort(int exit_code) noexcept = 0;
};

/// True if the environment shows that this process is one of several.
bool started_on_ranks();

/// Joins the other processes; null if there is only this one. Throws std::runtime_error with one
/// sentence if the module is missing or cannot be loaded.
std::unique_ptr<Ranks> open_ranks();

/// Number of processes on this machine according to the launcher, at least 1.
int ranks_on_this_machine();

/// Name of the C function that the module exports.
inline constexpr const char* open_ranks_symbol = "floatframe_open_ranks";
using OpenRanksFunction = Ranks* (*)();

}  // namespace floatframe
