#pragma once
// The content of a RunCheckpoint.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/core/histogram.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/stepping/state_bytes.hpp"

namespace floatframe {

/// An identity that must agree: its kind, and its value as text.
using RunIdentity = std::vector<std::pair<std::string, std::string>>;

/// Data that a run keeps in addition to its rows.
struct RunKeeps {
  bool rows = true, watch = true, state = false;
  std::string states = "none";  ///< recorded: see `record_text`
};

/// Describes which states are recorded.
std::string record_text(const RecordDescription& record, long every);

RunIdentity run_identity(const Model& model, const SimulationDescription& options,
                         const RunKeeps& keeps);

/// For a run, without its monitors.
struct RunMemory {
  std::int64_t made = 0;  ///< steps
  double cpu = 0.0;       ///< [s]
  Histogram step_times;   ///< of these steps
  StepperMemory steps;
  std::vector<double> joints;  ///< followed for the state at the end
};

void serialize_memory(StateWriter& s, const RunIdentity& identity, RunMemory& memory);
/// Throws InputError if the identity differs or the memory is not that of a run of `planned` steps
/// of that size, with this memory and number of joint coordinates.
RunMemory serialize_memory(StateReader& s, const RunIdentity& identity, const StepperMemory& own,
                           const Formulation& f, double step, std::size_t joints,
                           std::int64_t planned);

inline constexpr const char* checkpoint_name = "the checkpoint";

/// `watch` is a RunWatch, if there is one.
template <class Watch>
RunCheckpoint to_checkpoint(const RunIdentity& identity, RunMemory& memory,
                            std::optional<Watch>& watch) {
  StateWriter out;
  serialize_memory(out, identity, memory);
  if (watch) watch->serialize(out);
  return {memory.steps.state.t, std::move(out.bytes)};
}

/// Fills `watch`. See `walk_memory` for its exceptions.
template <class Watch>
RunMemory from_checkpoint(const RunCheckpoint& checkpoint, const RunIdentity& identity,
                          const StepperMemory& own, const Formulation& f, double step,
                          std::size_t joints, std::int64_t planned, std::optional<Watch>& watch) {
  StateReader in(checkpoint.bytes, checkpoint_name);
  RunMemory memory = serialize_memory(in, identity, own, f, step, joints, planned);
  if (watch) watch->serialize(in);
  if (!in.at_end())
    throw InputError(ErrorCode::damaged,
                     std::string(checkpoint_name) + " is damaged: there is data after its end");
  return memory;
}

}  // namespace floatframe
