#pragma once
// The processes of a study that was started on several at once (mpirun), as the study sees them:
// numbered 0 .. size-1, sending each other texts. The engine is MPI; it lives in a module of its
// own
// (`libfloatframe_mpi.so`) that is loaded only when the program was started that way, so that the
// program runs on machines without MPI.
#include <memory>
#include <string>

namespace floatframe {

struct RankMessage {
  int from = 0;
  std::string text;
};

/// All functions are for the thread that opened the ranks.
class Ranks {
 public:
  virtual ~Ranks() = default;  ///< waits until all ranks are at the end
  virtual int rank() const noexcept = 0;
  virtual int size() const noexcept = 0;
  virtual void send(int to, const std::string& text) = 0;
  /// The next message if one has arrived; does not wait.
  virtual bool receive(RankMessage& message) = 0;
  /// Ends all ranks at once.
  [[noreturn]] virtual void abort(int exit_code) noexcept = 0;
};

/// Whether the environment says that this process was started as one of several.
bool started_on_ranks();

/// Joins the other processes; null if there is only this one. Throws std::runtime_error with one
/// sentence if the module is missing or cannot be loaded.
std::unique_ptr<Ranks> open_ranks();

/// Number of processes on this machine as the launcher tells it, at least 1.
int ranks_on_this_machine();

/// What the module exports, as a C function of this name.
inline constexpr const char* open_ranks_symbol = "floatframe_open_ranks";
using OpenRanksFunction = Ranks* (*)();

}  // namespace floatframe
