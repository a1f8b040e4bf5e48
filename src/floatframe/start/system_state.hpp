#pragma once
// Stored states, and runs that start from one or away from an equilibrium.
#include <optional>
#include <span>
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/loops/start_report.hpp"

namespace floatframe {

/// The model with the start values of a state. Throws InputError if the state is of another model.
Model with_start_values(const Model& model, const SystemState& state);

/// The model that a run with these options starts from, if it differs from the given one.
std::optional<Model> started_model(const Model& model, const SimulationDescription& options);

/// Start of a run in relative coordinates: given values, equilibrium or a state, and offsets from
/// the latter two, with loops closed. Throws InputError for a state of another model, RunError if
/// there is no start state.
State start_state(RelativeFormulation& f, const SimulationDescription& options,
                  StartReport* report = nullptr);

/// Tracks the coordinates of all joints, so that turns are counted.
class JointFollower {
 public:
  explicit JointFollower(const Model& model);

  /// After a step.
  void follow(const SystemMotion& motion);
  const std::vector<SystemState::Joint>& joints() const noexcept { return joints_; }

  /// Coordinates and rates of all joints one after the other, to be stored with their time.
  std::vector<double> numbers() const;
  std::size_t size() const noexcept;
  double time() const noexcept { return time_; }
  /// `numbers`: `size()` of them, taken at time t.
  void restore(std::span<const double> numbers, double t) noexcept;

 private:
  std::vector<SystemState::Joint> joints_;
  double time_ = 0.0;
  bool started_ = false;
};

/// Poses and velocities of the bodies from the rest of a state.
void place_bodies(const Model& model, InertiaMethod inertia, SystemState& state);

/// The state of a motion, which `joints` follows; poses are set by `place_bodies`.
SystemState system_state(const SystemMotion& motion, JointFollower& joints);

}  // namespace floatframe
