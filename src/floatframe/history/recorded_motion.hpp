#pragma once
// The motion of a run from its states: the formulation of the run is set to a recorded instant -
// coordinates, velocities, accelerations of the integrator, turns of springs, inputs - and
// reproduces its values in the run to the bit. If the file has no accelerations they are solved for
// (reactions/reaction_solver.hpp), and differ from those of the run within its tolerance.
#include <memory>
#include <vector>

#include "floatframe/history/state_history.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

class RecordedMotion {
 public:
  /// `options`: those of the run, including the formulation of the states. All must outlive this.
  /// Throws InputError if the states are not of this model, RunError if the model cannot start.
  RecordedMotion(const StateHistory& history, const Model& model,
                 const SimulationDescription& options);
  ~RecordedMotion();
  RecordedMotion(const RecordedMotion&) = delete;
  RecordedMotion& operator=(const RecordedMotion&) = delete;

  std::size_t instants() const noexcept { return history_.instants(); }
  /// False: the states of this body were not recorded; the view has no motion of it.
  bool recorded(int body) const noexcept {
    return history_.header().bodies[static_cast<std::size_t>(body)].pose >= 0;
  }
  /// All bodies, markers and forces at an instant, in either formulation; valid until the next
  /// call. Without reactions, and without energies unless an output of the model needs them. Throws
  /// InputError if there is no such instant or its numbers are not finite.
  const SystemMotion& at(std::size_t k);
  /// The same without outputs, which are not brought there: cheaper, above all where one of them
  /// needs reactions. Accelerations that were not recorded are solved for if `accelerations`.
  const SystemMotion& without_outputs(std::size_t k, bool accelerations);
  /// Time and all outputs of the model at the instant of the last `at`. Outputs that count turns
  /// continue from the previous instant.
  const std::vector<double>& outputs() const noexcept { return outputs_; }

 private:
  struct Replay;

  const StateHistory& history_;
  std::vector<double> outputs_;
  std::unique_ptr<Replay> replay_;
};

}  // namespace floatframe
